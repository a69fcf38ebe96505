"""A C++ source file as tokens: enough of the language to find expressions and statements in code that clang-format has laid
out. Comments, strings and preprocessor lines are no tokens of an expression, and neither is anything outside of functions
except the values of constants."""

import bisect
import collections
import re
from typing import NamedTuple

TOKEN = re.compile(
    r"""
    (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
  | (?P<space>\s+)
  | (?P<comment>//[^\n]*|/\*.*?\*/)
  | (?P<string>(?:u8|[LuU])?R"(?P<delimiter>[^\s()\\]*)\(.*?\)(?P=delimiter)"|(?:u8|[LuU])?"(?:\\.|[^"\\\n])*")
  | (?P<char>'(?:\\.|[^'\\\n])+')
  | (?P<number>\.?\d(?:[eEpP][+-]|'?[\w.])*)
  | (?P<name>[A-Za-z_]\w*)
  | (?P<operator>->\*|<=>|<<=|>>=|\.\.\.|->|\+\+|--|::|&&|\|\||[-+*/%&|^<>=!]=|(?<=\s)(?:<<|>>)(?=\s)|<<|.)
    """,
    re.VERBOSE | re.MULTILINE | re.DOTALL,
)
CLOSES = {"(": ")", "[": "]", "{": "}"}
NO_TYPES = set(
    "return else case new delete throw typename class struct enum using constexpr static inline const auto mutable goto "
    "explicit friend virtual requires template namespace operator HD SELDOM if while for do co_return sizeof".split()
)
# What is between one of these words and the token named here is not changed.
PASSIVE_UNTIL = {"throw": ";", "static_assert": ";", "using": ";", "friend": ";", "operator": "(", "case": ":", "goto": ";"}


class Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


class Source:
    """`tokens`: the tokens without space, comments and directives. `partner`: of each bracket, the index of the other one.
    `function`: of each token, the number of the function whose body it is in, or -1. `live`: whether it may be changed."""

    def __init__(self, path, text):
        self.path, self.text = path, text
        self.tokens = [
            Token(m.lastgroup if m.lastgroup != "delimiter" else "string", m.group(), m.start(), m.end())
            for m in TOKEN.finditer(text)
            if m.lastgroup not in ("space", "comment", "directive")
        ]
        self.texts = [token.text for token in self.tokens]
        self.places = collections.defaultdict(list)  # the indices of each name
        for i, token in enumerate(self.tokens):
            if token.kind == "name":
                self.places[token.text].append(i)
        self.line_starts = [0] + [m.end() for m in re.finditer("\n", text)]
        self._match_brackets()
        self._find_functions()
        self._find_live()

    def line_of(self, position):
        """The number, from 0, of the line with this character."""
        return bisect.bisect_right(self.line_starts, position) - 1

    def text_between(self, first, end):
        """The text of the tokens first ... end - 1."""
        return self.text[self.tokens[first].start : self.tokens[end - 1].end]

    def spaced(self, i):
        """Whether there is white space on both sides: an operator of an expression, and not part of a type."""
        token = self.tokens[i]
        return self.text[token.start - 1].isspace() and self.text[token.end : token.end + 1].isspace()

    def angle_end(self, i):
        """The index after the `>` that closes the `<` at i, if that opens template arguments (no space around); else i."""
        if self.texts[i : i + 1] != ["<"] or self.text[self.tokens[i].end].isspace():
            return i
        depth = 0
        for j in range(i, min(i + 60, len(self.tokens))):
            if self.texts[j] in (";", "{", "}", "&&", "||"):
                return i
            depth += (self.texts[j] == "<") - (self.texts[j] == ">" and not self.spaced(j))
            if depth == 0:
                return j + 1
        return i

    def _match_brackets(self):
        self.partner, stack = {}, []
        for i, text in enumerate(self.texts):
            if text in CLOSES:
                stack.append(i)
            elif text in CLOSES.values() and stack:
                self.partner[i] = stack.pop()
                self.partner[self.partner[i]] = i

    def _find_functions(self):
        """A function body is a brace after a head with parentheses that is not the head of a class or an initialiser."""
        self.function, self.bodies = [-1] * len(self.tokens), []
        i = head = 0
        while i < len(self.tokens):
            if self.texts[i] == "template":
                head = self._end_of_template(i)
                i = head
                continue
            if self.texts[i] == "{" and i in self.partner:
                words = self.texts[head:i]
                if "(" in words and not {"class", "struct", "namespace", "enum", "=", "concept"} & set(words):
                    last = self.partner[i]
                    self.function[head : last + 1] = [len(self.bodies)] * (last + 1 - head)
                    self.bodies.append((head, i, last))
                    i = last
            if self.texts[i] in (";", "{", "}") or self.texts[i - 1 : i + 1] in (["public", ":"], ["private", ":"]):
                head = i + 1
            i += 1

    def _end_of_template(self, i):
        depth = 0
        for j in range(i + 1, len(self.tokens)):
            depth += (self.texts[j] == "<") - (self.texts[j] == ">")
            if depth == 0:
                return j + 1
        return len(self.tokens)

    def _find_live(self):
        self.live = [False] * len(self.tokens)
        for _, opening, closing in self.bodies:
            self.live[opening + 1 : closing] = [True] * (closing - opening - 1)
        for i, text in enumerate(self.texts):
            if text == "constexpr" and self.function[i] < 0 and "=" in self.texts[i : (end := self._find(i, ";"))]:
                self.live[i:end] = [True] * (end - i)
            if text in PASSIVE_UNTIL:
                end = self._find(i, PASSIVE_UNTIL[text])
            elif text == "template":
                end = self._end_of_template(i)
            elif text == "constexpr" and self.texts[i + 1 : i + 2] == ["("]:
                end = self.partner[i + 1]
            elif text == "enum" and (brace := self._find(i, "{")) in self.partner:
                end = self.partner[brace]
            elif text == "<" and (after := self.angle_end(i)) > i:  # template arguments
                end = after - 1
            elif self.tokens[i].kind == "string":  # with text, operators and shifts are those of text
                i, end = self.statement(i)
            else:
                continue
            self.live[i : end + 1] = [False] * (end + 1 - i)

    def _find(self, i, text):
        """The index of the next token with this text outside of brackets."""
        while i < len(self.tokens) and self.texts[i] != text:
            i = self.partner[i] + 1 if self.texts[i] in CLOSES and i in self.partner else i + 1
        return i

    def statement(self, i):
        """The first token and the last (the `;`) of the statement around i."""
        first, last = i, i
        while first > 0 and self.texts[first - 1] not in (";", "{", "}"):
            first -= 1
        while last + 1 < len(self.tokens) and self.texts[last] not in (";", "{", "}"):
            last += 1
        return first, last
