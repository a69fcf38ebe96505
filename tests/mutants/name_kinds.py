"""The kinds of mutants that take one name or index for another; edits as in operator_kinds.py."""

from operands import add_declared, end_of_operand, still_used
from operator_kinds import binary, ends_operand, in_head_of_for

PAIRS = (
    "s t|light eye|lower upper|left right|pdf_fwd pdf_rev|eta_i eta_t|wo wi|wo_local wi_local|near far|first last|e1 e2|"
    "b1 b2|u1 u2|width height|entering leaving|a b|parallel perpendicular"
)
PARTNER = {name: other for pair in PAIRS.split("|") for name, other in (pair.split(), pair.split()[::-1])}
SYMMETRIC = set("min max unite dot intersection lesser greater larger smaller same_box area_of_both".split())


def off_by_one(source, types):
    """An index, the first value of a loop, or a term of 1."""
    texts, tokens = source.texts, source.tokens
    for i in binary(source, {"+", "-"}):
        if texts[i + 1] in ("1", "1u") and texts[i + 2] not in ("*", "/", "%", "<<", ">>"):
            yield tokens[i - 1].end, tokens[i + 1].end, ""
    for i in range(2, len(tokens) - 2):
        if not source.live[i]:
            continue
        if texts[i] == "[" and ends_operand(source, i - 1) and not is_declared(source, i - 1):
            yield from _index(source, i)
        first = texts[i + 1]
        if texts[i] == "=" and first in ("0", "1", "2") and texts[i + 2] == ";" and in_head_of_for(source, i):
            yield tokens[i + 1].start, tokens[i + 1].end, "1" if first == "0" else str(int(first) - 1)


def _index(source, i):
    texts, close = source.texts, source.partner[i]
    if close == i + 2 and texts[i + 1].isdigit():
        n = int(texts[i + 1])
        with_one = (texts[j + 1 : j + 4] == ["[", "1", "]"] for j in source.places[texts[i - 1]])
        if n > 0 or any(with_one):
            yield source.tokens[i + 1].start, source.tokens[i + 1].end, str(n - 1 if n > 0 else 1)
    elif end_of_operand(source, i + 1) == close and texts[i + 1] != "!":
        yield source.tokens[close].start, source.tokens[close].start, " + 1"


def is_declared(source, i):
    """Whether the name at i is declared there, as `const T& name` or in `auto [name, other]`."""
    before = source.texts[i - 1]
    if before in (",", "["):
        j = i - 1
        while j > 0 and (source.tokens[j].kind == "name" or source.texts[j] == ","):
            j -= 1
        return source.texts[j] == "[" and source.texts[j - 1] in ("auto", "&")
    if before in ("&", "*", ">", "&&"):
        return not source.text[source.tokens[i - 1].start - 1].isspace()
    return source.tokens[i - 1].kind == "name" and before not in ("return", "else")


def _exchange_names(source, partners, members_only):
    texts = source.texts
    for i in range(1, len(texts) - 1):
        if not source.live[i] or source.tokens[i].kind != "name" or texts[i] not in partners or is_declared(source, i):
            continue
        other, is_member = partners[texts[i]], texts[i - 1] in (".", "->")
        if texts[i - 1] == "::" or (texts[i + 1] == "(" and not is_member) or (members_only and not is_member):
            continue
        head, _, last = source.bodies[source.function[i]] if source.function[i] >= 0 else (i, i, i)
        there = {texts[j - 1] in (".", "->") for j in source.places[other] if is_member or head <= j < last}
        if not is_member:
            add_declared(local := {}, source, head, last)
            if local.get(texts[i]) != local.get(other):
                continue
        if (is_member if members_only else is_member in there) and still_used(source, i, i + 1):
            yield source.tokens[i].start, source.tokens[i].end, other


def swapped_name(source, types):
    """s for t, and other pairs of names, where both have the same type."""
    yield from _exchange_names(source, PARTNER, members_only=False)


def swapped_axis(source, types):
    yield from _exchange_names(source, {"x": "y", "y": "z", "z": "x"}, members_only=True)


def swapped_arguments(source, types):
    """Two arguments of a call, beside each other and of the same type."""
    texts = source.texts
    for i in range(1, len(texts) - 4):
        if not source.live[i] or texts[i] != "(" or source.tokens[i - 1].kind != "name" or texts[i - 1] in SYMMETRIC:
            continue
        at = i + 1
        while (end := end_of_operand(source, at)) > at and texts[end] == "," and at < source.partner[i]:
            after = end_of_operand(source, end + 1)
            complete = texts[after] in (",", ")") and after > end + 1
            if complete and _same_type(source, (at, end), (end + 1, after), types):
                one, other = (source.text_between(a, b) for a, b in ((at, end), (end + 1, after)))
                yield source.tokens[at].start, source.tokens[after - 1].end, f"{other}, {one}"
            at = end + 1


def _same_type(source, one, other, types):
    a, b = (source.texts[first:end] for first, end in (one, other))
    if a == b:
        return False
    if len(a) == len(b) == 4 and a[0] == b[0] and a[1] == b[1] == "[":
        return True
    return len(a) == len(b) == 1 and len(types.get(a[0], ())) == 1 and types[a[0]] == types.get(b[0]) != {"?"}
