"""The small deliberate bugs that `make mutate` tries: every place of a source file where one may stand."""

import re
from dataclasses import dataclass


@dataclass(frozen=True)
class Mutant:
    file: str  # below the repository
    line: int  # the first is 1
    kind: str
    before: str  # the line
    after: str  # what takes its place

    def __str__(self):
        return f"{self.file}:{self.line}: {self.kind}\n  - {self.before.strip()}\n  + {self.after.strip()}"


# Words between blanks: clang-format puts none around the brackets of templates.
EXCHANGED = {
    "<": [("boundary", "<="), ("comparison", ">=")],
    "<=": [("boundary", "<"), ("comparison", ">")],
    ">": [("boundary", ">="), ("comparison", "<=")],
    ">=": [("boundary", ">"), ("comparison", "<")],
    "==": [("comparison", "!=")],
    "!=": [("comparison", "==")],
    "+": [("arithmetic", "-")],
    "-": [("arithmetic", "+")],
    "*": [("arithmetic", "/")],
    "/": [("arithmetic", "*")],
    "+=": [("arithmetic", "-=")],
    "-=": [("arithmetic", "+=")],
    "*=": [("arithmetic", "/=")],
    "/=": [("arithmetic", "*=")],
    "&&": [("logic", "||")],
    "||": [("logic", "&&")],
}
FUNCTIONS = {
    "std::min": "std::max",
    "std::max": "std::min",
    "std::sin": "std::cos",
    "std::cos": "std::sin",
    "std::floor": "std::ceil",
    "std::ceil": "std::floor",
    "true": "false",
    "false": "true",
    "continue": "break",
    "break": "continue",
}
NUMBER = re.compile(r"(?<![\w.'])(\d+\.?\d*(?:e-?\d+)?|\.\d+)(f?)(?![\w.'])")
WORD = re.compile(r"(?<![\w:])(" + "|".join(map(re.escape, FUNCTIONS)) + r")(?![\w:])")
OPERATOR = re.compile(r"(?<= )(" + "|".join(map(re.escape, sorted(EXCHANGED, key=len, reverse=True))) + r")(?= )")
CONDITION = re.compile(r"\b(?:if|while) \(")
ARGUMENTS = re.compile(r"(?<=\w\()([\w.\[\]]+), ([\w.\[\]]+)(?=[,)])")
# A statement of its own: an assignment, a call, a step; no declaration, nothing that leaves a block.
STATEMENT = re.compile(r"^\s+(?!return|break|continue|throw|using|case|else|for|if|while|const|auto|static|delete|HBR_CHECK)"
                       r"[\w.\[\]()>*&:-]+(?: [-+*/|&]?= .*|\(.*\)|\+\+|--);$")
RETURN = re.compile(r"^(\s+(?:if \(.*\) )?)return [^;{]+;$")
# What no test can be asked to see: how much is reserved, what checks ourselves, and what is said; when it is said can be.
PASSED_OVER = re.compile(r"^\s*(#|//|HBR_CHECK|static_assert|template|using|namespace|class|struct|\w+\.reserve\()")
SAID = re.compile(r"InputError|fmt::|fail\(\"")


def code_of(lines):
    """The lines with comments and texts blanked out; places in a line stay as they are."""
    kept = []
    for line in lines:
        line = re.sub(r'"(?:\\.|[^"\\])*"' + r"|'(?:\\.|[^'\\])'", lambda m: '"' + " " * (len(m.group()) - 2) + '"', line)
        cut = line.find("//")
        kept.append(line if cut < 0 else line[:cut].rstrip())
    return kept


def changed_number(text, suffix):
    if text.isdigit():
        return ("0" if text == "1" else str(int(text) + 1)) + suffix
    value = float(text)
    return repr(value * 1.25 if value else 1.0) + suffix


def conditions(code):
    """(begin, end) of each condition that ends in its line."""
    for m in CONDITION.finditer(code):
        depth = 1
        for at in range(m.end(), len(code)):
            depth += (code[at] == "(") - (code[at] == ")")
            if depth == 0:
                yield m.end(), at
                break


def changes(code):
    """(kind, begin, end, text) of each bug in a line of code; no text: what stands there, denied."""
    for m in OPERATOR.finditer(code):
        for kind, other in EXCHANGED[m.group()]:
            yield kind, m.start(), m.end(), other
    for m in WORD.finditer(code):
        yield "word", m.start(), m.end(), FUNCTIONS[m.group()]
    for m in NUMBER.finditer(code):
        yield "constant", m.start(), m.end(), changed_number(m.group(1), m.group(2))
    for begin, end in conditions(code):
        yield "negated", begin, end, None
    for m in ARGUMENTS.finditer(code):
        if m.group(1) != m.group(2):
            yield "swapped", m.start(), m.end(), f"{m.group(2)}, {m.group(1)}"
    if STATEMENT.match(code):
        yield "dropped", 0, len(code), ";"
    if m := RETURN.match(code):
        yield "returned", 0, len(code), m.group(1) + "return {};"


def mutants_of(file, text):
    lines = text.split("\n")
    skipping = False  # a check or a complaint goes on until its statement ends
    for number, (line, code) in enumerate(zip(lines, code_of(lines)), 1):
        found = changes(code)
        if skipping or PASSED_OVER.search(code) or SAID.search(code):
            found = [] if skipping or PASSED_OVER.search(code) else [("negated", *c, None) for c in conditions(code)]
            skipping = not code.rstrip().endswith((";", "{", "}")) and bool(code.strip()) and not code.startswith("#")
        for kind, begin, end, other in found:
            other = f"!({line[begin:end]})" if other is None else other
            after = line[:begin] + other + line[end:]
            if after != line:
                yield Mutant(file, number, kind, line, after)
