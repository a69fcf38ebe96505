"""The kinds of mutants that change one operator or number of an expression. Each is a function of a source file and the
types of names (operands.declared_types) that yields the edits it can make: (start, end, replacement) of the text."""

import decimal

from operands import BEFORE_OPERAND, end_of_operand, is_scalar, start_of_operand, still_used

SIGNED = {"int", "double", "float", "F", "int64_t"}
CALLS_TO_FORGET = {"abs", "magnitude_of", "sqrt", "square_root", "normalize"}
BOUNDARY = set("( [ { } ; , ? : = += -= *= /= return".split())


def ends_operand(source, i):
    token = source.tokens[i]
    return (token.kind in ("name", "number") and token.text != "return") or token.text in (")", "]")


def in_head_of_for(source, i):
    while i > 0 and source.texts[i] not in ("(", "{", "}"):
        i = source.partner[i] - 1 if source.texts[i] in (")", "]") else i - 1
    return source.texts[i - 1 : i + 1] == ["for", "("]


def binary(source, operators):
    """The indices of these operators between two operands."""
    for i in range(1, len(source.tokens) - 1):
        if source.live[i] and source.texts[i] in operators and source.spaced(i) and ends_operand(source, i - 1):
            yield i


def exchange(source, operators):
    for i in binary(source, operators):
        if source.texts[i].endswith("=") and source.texts[i] not in ("==", "!=") and in_head_of_for(source, i):
            continue  # of `i += 2`: the loop would not end
        yield source.tokens[i].start, source.tokens[i].end, operators[source.texts[i]]


def plus_minus(source, types):
    yield from exchange(source, {"+": "-", "-": "+", "+=": "-=", "-=": "+="})


def times_over(source, types):
    yield from exchange(source, {"*": "/", "/": "*", "*=": "/=", "/=": "*="})


def drop_factor(source, types):
    """One factor that is a number: the type of the product does not change. Also a divisor."""
    for i in binary(source, {"*", "/"}):
        start, end = start_of_operand(source, i - 1), end_of_operand(source, i + 1)
        if end > i + 1 and is_scalar(source, i + 1, end, types) and still_used(source, i + 1, end):
            yield source.tokens[i - 1].end, source.tokens[end - 1].end, ""
        if source.texts[i] == "/" or start > i - 1 or source.texts[start - 1] in ("/", "%", ".", "->"):
            continue
        if is_scalar(source, start, i, types) and still_used(source, start, i):
            yield source.tokens[start].start, source.tokens[i + 1].start, ""


def forget_call(source, types):
    """abs, sqrt, normalize: only their argument is left."""
    for i in range(2, len(source.tokens) - 1):
        if source.live[i] and source.texts[i] in CALLS_TO_FORGET and source.texts[i + 1] == "(":
            first = i - 2 if source.texts[i - 1] == "::" else i
            if source.tokens[first - 1].kind != "name" or source.texts[first - 1] == "return":
                yield source.tokens[first].start, source.tokens[i].end, ""


def less(source, types):
    changed = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
    for i in binary(source, changed):
        # An unsigned number is always >= 0, and the compiler says so.
        start = start_of_operand(source, i - 1)
        known = types.get(source.texts[i - 1], {"?"}) <= SIGNED and start < i
        if source.texts[i] == "<=" or source.texts[i + 1] != "0" or source.texts[i] == "<" or known:
            yield source.tokens[i].start, source.tokens[i].end, changed[source.texts[i]]


def equal(source, types):
    yield from exchange(source, {"==": "!=", "!=": "=="})


def and_or(source, types):
    """All && of a condition become ||, or all || become &&: mixed ones need parentheses."""
    for i in binary(source, {"&&", "||"}):
        operators = {i} | {j for j in level(source, i) if source.texts[j] in ("&&", "||")}
        if i == min(operators) and len({source.texts[j] for j in operators}) == 1:
            start, end, text = source.tokens[i].start, source.tokens[max(operators)].end, source.text
            for j in operators:
                token = source.tokens[j]
                text = text[: token.start] + ("&&" if token.text == "||" else "||") + text[token.end :]
            yield start, end, text[start:end]


def level(source, i, boundary=BOUNDARY):
    """The indices of the tokens of the expression around i, without what is in brackets."""
    found, j = [], i
    while j >= 0 and source.texts[j] not in boundary:
        j = source.partner[j] if source.texts[j] in (")", "]") else j
        found.append(j)
        j -= 1
    j = i + 1
    while j < len(source.texts) and source.texts[j] not in boundary - {"(", "["} and source.texts[j] not in (")", "]"):
        found.append(j)
        j = source.partner[j] + 1 if source.texts[j] in ("(", "[") else j + 1
    return found


def min_max(source, types):
    pairs = (("min", "max"), ("lesser", "greater"), ("smaller", "larger"))
    partners = {name: other for pair in pairs for name, other in (pair, pair[::-1])}
    for i in range(2, len(source.tokens) - 1):
        name = source.texts[i]
        if source.live[i] and name in partners and source.texts[i + 1] == "(":
            if name not in ("min", "max") or source.texts[i - 2 : i] in (["std", "::"], ["glm", "::"]):
                yield source.tokens[i].start, source.tokens[i].end, partners[name]


def drop_not(source, types):
    yield from _drop_unary(source, "!")


def drop_minus(source, types):
    yield from _drop_unary(source, "-")


def _drop_unary(source, operator):
    for i in range(1, len(source.tokens) - 1):
        if source.live[i] and source.texts[i] == operator and not source.spaced(i):
            if source.texts[i - 1] in BEFORE_OPERAND:
                yield source.tokens[i].start, source.tokens[i].end, ""


def relaxed(source, types):
    for i, text in enumerate(source.texts if "memory_order" in source.text or "__ATOMIC" in source.text else ()):
        for strict in ("acq_rel", "acquire", "release", "seq_cst"):
            after_scope = source.texts[i - 2 : i] == ["memory_order", "::"]
            if text == f"memory_order_{strict}" or (text == strict and after_scope):
                yield source.tokens[i].start, source.tokens[i].end, text.replace(strict, "relaxed")
            if text == f"__ATOMIC_{strict.upper()}":
                yield source.tokens[i].start, source.tokens[i].end, "__ATOMIC_RELAXED"


def constant(source, types):
    """2 becomes 1, 0.5 becomes 1.0; other whole numbers are less by one, other fractions twice as large.

    Hexadecimal and binary numbers are left alone."""
    for i in range(1, len(source.tokens) - 1):
        number, around = source.texts[i], (source.texts[i - 1], source.texts[i + 1])
        if source.tokens[i].kind != "number" or not source.live[i] or around[0] == "[":
            continue
        if number.lower().startswith(("0x", "0b")):
            continue
        if number.rstrip("uU").isdigit():
            digits = number.rstrip("uU")
            changed = str(int(digits) - 1) + number[len(digits) :] if int(digits) >= 2 else ""
        else:
            digits = number.rstrip("fF").replace("'", "")
            value = decimal.Decimal(digits)
            if value == 0 or (value == 1 and around[1] not in ("-", "+", "/")):
                continue
            twice = {decimal.Decimal(2): "1.0"}.get(value, str(2 * value))
            changed = twice.replace("E", "e") + ("f" if number[-1] in "fF" else "")
        if changed:
            yield source.tokens[i].start, source.tokens[i].end, changed


def shift_mask(source, types):
    for i in binary(source, {"<<", ">>", "&", "|"}):
        mixed = {source.texts[j] for j in level(source, i)} & {"&", "|", "^", "<<", ">>", "+", "-", "=="}
        if source.texts[i] in ("<<", ">>") or mixed == {source.texts[i]}:
            changed = {"<<": ">>", ">>": "<<", "&": "|", "|": "&"}[source.texts[i]]
            yield source.tokens[i].start, source.tokens[i].end, changed


def flip_bool(source, types):
    for i, text in enumerate(source.texts):
        if source.live[i] and text in ("true", "false"):
            yield source.tokens[i].start, source.tokens[i].end, "false" if text == "true" else "true"
