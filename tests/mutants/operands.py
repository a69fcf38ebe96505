"""Operands in the tokens of a C++ file: where they begin and end, and what is known of their types."""

import re

from cpp_source import CLOSES, NO_TYPES

SCALARS = {"double", "float", "int", "F", "size_t", "uint32_t", "uint64_t", "int64_t", "unsigned"}
# Functions of libraries with one number as result.
SCALAR_CALLS = {"std::abs", "std::sqrt", "std::pow", "std::exp", "std::fma", "std::cos", "std::sin", "std::copysign",
                "glm::dot", "glm::length"}  # fmt: skip
BEFORE_OPERAND = set("( [ { , = return ? : ; + - * / % < > <= >= == != && || ! += -= *= /= & | ^ << >> }".split())


def end_of_operand(source, i):
    """The index after the operand that starts at i: a name, number or group, with its calls, subscripts and members. i
    itself if there is none."""
    texts, tokens, start = source.texts, source.tokens, i
    if i >= len(tokens):
        return start
    if texts[i] in ("-", "!"):
        i += 1
    if texts[i] == "(":
        i = source.partner[i] + 1
    elif tokens[i].kind == "number":
        return i + 1
    elif tokens[i].kind == "name" and texts[i] not in ("return", "const"):
        i += 1
    else:
        return start
    while i < len(tokens):
        if texts[i] in ("(", "["):
            i = source.partner[i] + 1
        elif texts[i] == "{" and source.text[tokens[i].start - 1] != " ":
            i = source.partner[i] + 1
        elif texts[i] in (".", "->", "::") and tokens[i + 1].kind == "name":
            i += 2
        elif (after := source.angle_end(i)) > i:
            i = after
        else:
            return i
    return i


def start_of_operand(source, last):
    """The index of the first token of the operand whose last token is `last`; last + 1 if there is none."""
    texts, tokens, i = source.texts, source.tokens, last
    while i > 0:
        if texts[i] in CLOSES.values() and i in source.partner:
            i = source.partner[i]
            before = i - 1
            if texts[before] == ">" and not source.spaced(before):
                while before > 0 and source.angle_end(before) != i:
                    before -= 1
                i, before = before, before - 1
            if tokens[before].kind == "name" and texts[before] not in ("return", "if", "while"):
                i = before
            elif texts[before] in (")", "]") and texts[i] in ("(", "["):
                i = before
                continue
        elif tokens[i].kind not in ("name", "number"):
            return last + 1
        if texts[i - 1] in (".", "->", "::"):
            i -= 2
            continue
        return i
    return last + 1


def declared_types(sources):
    """The names that are declared in these files (variables, members, functions), each with the set of its types."""
    types = {}
    for source in sources:
        add_declared(types, source, 1, len(source.tokens) - 1)
    return types


def add_declared(types, source, begin, end):
    """Adds the names that the tokens begin ... end - 1 declare."""
    texts, tokens = source.texts, source.tokens
    for i in range(begin, end):
        if tokens[i].kind != "name" or texts[i + 1] not in ("=", ";", ",", ")", "{", "(", ":", "["):
            continue
        j = i - 1
        while j > 0 and (texts[j] == "const" or (texts[j] in ("&", "*") and not source.spaced(j))):
            j -= 1
        if tokens[j].kind == "name" and texts[j] not in NO_TYPES:
            kind = texts[j] + ("*" if "*" in texts[j:i] else "") + ("[]" if texts[i + 1] == "[" else "")
            types.setdefault(texts[i], set()).add(kind)
        elif texts[j] in (">", "auto") and not source.spaced(j):
            types.setdefault(texts[i], set()).add("?")


def is_scalar(source, first, end, types):
    """Whether the operand first ... end - 1 is certainly one number."""
    if source.texts[first] in ("-", "!"):
        first += 1
    if end == first + 1 and source.tokens[first].kind == "number":
        return True
    words = source.texts[first:end]
    joined = "".join(words)
    if re.fullmatch(r"static_cast<(double|float|F|int|std::\w+)>\(.*\)", joined) and source.partner[end - 1] == first + 4:
        return True
    if words[-1] in ("x", "y", "z") and words[-2:-1] == ["."]:
        return True
    if words[-1] == ")" and source.partner[end - 1] > first:  # a call
        name_at = source.partner[end - 1] - 1
        called = "".join(words[: name_at - first + 1])
        if called in SCALAR_CALLS:
            return True
        last = source.texts[name_at]
    elif words[-1] == ")":  # a group, of operands that are numbers
        return _all_scalar(source, first + 1, end - 1, types)
    else:
        last = words[-1]
    return bool(types.get(last)) and types[last] <= SCALARS


def _all_scalar(source, i, end, types):
    while i < end:
        after = end_of_operand(source, i)
        if after > i:
            if not is_scalar(source, i, after, types):
                return False
            i = after
        elif source.texts[i] in ("+", "-", "*", "/"):
            i += 1
        else:
            return False
    return True


def still_used(source, first, end):
    """Whether every local variable and parameter in first ... end - 1 is used elsewhere in its function, too: the compiler
    rejects unused ones."""
    number = source.function[first]
    if number < 0:
        return True
    head, _, last = source.bodies[number]
    for name in {source.texts[i] for i in range(first, end) if source.tokens[i].kind == "name"}:
        here = (i for i in source.places[name] if head <= i < last)
        uses = [i for i in here if source.texts[i - 1] not in (".", "->", "::")]
        declared = any(
            (source.tokens[i - 1].kind == "name" or source.texts[i - 1] in ("&", "*", ">"))
            and source.texts[i - 1] not in ("return", "else")
            and source.texts[i + 1] in ("=", ";", ",", ")", "{", ":", "(")
            for i in uses
            if not (source.texts[i - 1] in ("*", "&", ">") and source.spaced(i - 1))
        )
        if declared and sum(not first <= i < end for i in uses) < 2:
            return False
    return True
