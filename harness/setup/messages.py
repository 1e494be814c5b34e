"""The messages of C++ sources: string literals, joined where an expression joins them, for prose.py beside this file."""
import re

# Comments, literals with their prefixes, numbers with separators, names, and single characters.
token = re.compile(r"""
    (?P<space>\s+|//[^\n]*(?:\\\n[^\n]*)*|/\*.*?\*/)
  | (?P<directive>^[ \t]*\#[^\n]*(?:\\\n[^\n]*)*)
  | (?P<raw>(?:u8|[uUL])?R"(?P<fence>[^()\\\s]*)\((?P<inside>.*?)\)(?P=fence)")
  | (?P<text>(?:u8|[uUL])?"(?P<letters>(?:\\.|[^"\\\n])*)"\w*)
  | (?P<letter>(?:u8|[uUL])?'(?:\\.|[^'\\\n])+')
  | (?P<word>[\w']*\w)
  | (?P<mark>::|<<|->|.)
""", re.DOTALL | re.MULTILINE | re.VERBOSE)
opens, closes = {"(": ")", "[": "]", "{": "}"}, {")", "]", "}"}
ends = {",", ";", "?", ":", "=", "{", "}", ")", "]", "return"}
value = "CODE"  # in place of what an expression computes


def tokens(text):
    """(line, kind, text) of everything that is neither white space, a comment nor a directive."""
    line = 1
    for match in token.finditer(text):
        kind = match.lastgroup
        if match["raw"] is not None:
            yield line, "raw", match["inside"]
        elif match["text"] is not None:
            yield line, "text", match["letters"]
        elif match["word"] is not None or match["letter"] is not None:
            yield line, "word", match[0]
        elif match["mark"] is not None:
            yield line, "mark", match[0]
        line += match[0].count("\n")


def plain(letters):
    return re.sub(r"\\(.)", lambda match: {"n": "\n", "t": " ", '"': '"', "\\": "\\"}.get(match[1], " "), letters)


def group_end(parts, begin):
    """Behind the bracket that closes the one at begin."""
    depth = 0
    for place in range(begin, len(parts)):
        if parts[place][1] == "mark":
            depth += (parts[place][2] in opens) - (parts[place][2] in closes)
            if depth == 0:
                return place + 1
    return len(parts)


def expression(parts, begin):
    """The text of the joined literals from begin on, and the place where the expression ends."""
    text, place = "", begin
    while place < len(parts):
        _, kind, part = parts[place]
        if kind == "text":
            text, place = text + plain(part), place + 1
        elif kind == "mark" and part in ("(", "["):
            place = group_end(parts, place)
            text += "" if text.endswith(value) else value
        elif kind in ("mark", "word") and part in ends or kind == "raw":
            break
        else:
            text += value if kind == "word" and not text.endswith(value) else ""
            place += 1
    return text, place


def messages(text):
    """(line, message) of every string literal, once, with the literals and values that its expression joins to it."""
    parts = list(tokens(text))
    done = set()
    for place, (line, kind, _) in enumerate(parts):
        if kind != "text" or place in done:
            continue
        message, end = expression(parts, place)
        depth = 0
        for other in range(place, end):  # literals in brackets are messages of their own
            if parts[other][1] == "mark":
                depth += (parts[other][2] in opens) - (parts[other][2] in closes)
            if parts[other][1] == "text" and depth == 0:
                done.add(other)
        if place and parts[place - 1][2] in ("+", "<<"):
            message = value + message
        yield line, message
