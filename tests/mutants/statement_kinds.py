"""The kinds of mutants that change or leave out a statement; edits as in operator_kinds.py."""

from operands import end_of_operand, still_used
from operator_kinds import level

UPDATES = {"=", "+=", "-=", "*=", "/=", "|=", "&=", "^="}


def negate_condition(source, types):
    """Of an if, or of a choice between two values."""
    texts, tokens = source.texts, source.tokens
    for i in range(1, len(tokens) - 2):
        if not source.live[i]:
            continue
        if texts[i] == "if" and texts[i + 1] == "(":
            first, end = i + 2, source.partner[i + 1]
            simple = texts[first] == "!" and end_of_operand(source, first) == end  # drop_not makes the same mutant
            if not simple and not {"=", ";"} & set(texts[first:end]):
                yield _negated(source, first, end)
        if texts[i] == "?" and source.spaced(i):
            before = [j for j in level(source, i - 1, set("( [ { } ; , ? : = += -= *= /= return".split())) if j < i]
            first = min(before) if before else i
            if first < i and not (texts[first] == "!" and end_of_operand(source, first) == i):
                yield _negated(source, first, i)


def _negated(source, first, end):
    start, stop = source.tokens[first].start, source.tokens[end - 1].end
    return start, stop, f"!({source.text[start:stop]})"


def _statement_starts(source):
    """The index of the first token of each statement, and whether it is all that an if, else or loop controls."""
    for i in range(1, len(source.tokens) - 1):
        if not source.live[i]:
            continue
        before = source.texts[i - 1]
        if before in (";", "{", "}") and not _in_parentheses(source, i):
            yield i, False
        elif before == "else":
            yield i, True
        elif before == ")" and source.texts[source.partner[i - 1] - 1] in ("if", "for", "constexpr"):
            yield i, True


def _in_parentheses(source, i):
    """Whether the statement at i is a part of the head of a for or an if, or an element of a braced list."""
    j = i - 1
    if source.texts[j] == "{":
        return source.texts[j - 1] not in (")", "const", "else", "do", "try", ";", "{", "}")
    if source.texts[j] == "}":
        return source.texts[i] in (",", ";", ")", ".")
    while j > 0:
        if source.texts[j] in (")", "]", "}"):
            j = source.partner[j]
        elif source.texts[j] in ("(", "{"):
            return source.texts[j] == "("
        j -= 1
    return False


def skip_update(source, types):
    """A variable keeps its value: an assignment, an increment or a push_back is missing."""
    texts = source.texts
    for i, controlled in _statement_starts(source):
        end = end_of_operand(source, i)
        prefix = texts[i] in ("++", "--")
        if prefix:
            end = end_of_operand(source, i + 1)
        last = source.statement(end)[1] if end > i else i
        while texts[last] in ("{", "}") and last + 1 < len(texts):  # braces of a value
            last = source.statement(last + 1)[1]
        is_update = end > i and (texts[end] in UPDATES or prefix or "push_back" in texts[i:end])
        if is_update and texts[last] == ";" and source.live[last] and "[" not in texts[last : last + 1]:
            if "&" not in texts[end + 1 : last][:1] and still_used(source, i, last):
                yield source.tokens[i].start, source.tokens[last].end, "{}" if controlled else ""


def drop_guard(source, types):
    """An early exit is missing: if (...) return ...; or continue, or break."""
    texts = source.texts
    for i, controlled in _statement_starts(source):
        if controlled or texts[i : i + 2] != ["if", "("] or "=" in texts[i : source.partner[i + 1]]:
            continue
        body = source.partner[i + 1] + 1
        if texts[body] not in ("return", "continue", "break"):
            continue
        last = body
        while texts[last] != ";":
            last = source.partner[last] + 1 if texts[last] in ("(", "[", "{") else last + 1
        if texts[last + 1] != "else" and still_used(source, i, last):
            yield source.tokens[i].start, source.tokens[last].end, ""
