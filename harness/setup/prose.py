#!/usr/bin/env python3
"""Finds sentences that a reader stumbles over, in pages, comments, messages and help (docs/style.md, "Words").

  prose.py ROOT       every page and source below ROOT, except generated pages; then the mean and the longest sentence
                      of pages, headers and messages
  prose.py FILE...    these files, with their mean length of a sentence

Looks for sentences of more than 30 words, a second semicolon, comments and messages that begin without their noun, and
"but for" or "all but". A page of more than ten sentences may have a mean of 16 words, and so may all pages, headers and
messages. Prints file:line: sentence and ends with 1.
"""
import re
import sys
from pathlib import Path

from messages import messages
from source_tags import tell

most_words = 30
most_mean_words = 16
headless = re.compile(r"(Of|What|Whose|Whom|None|Nobody|Who|By(?! [A-Z])|But for|All but|Such|Neither)\b")
headless_message = re.compile(r"(of|whose|whom|by|what|which|neither)\b(?! at (least|most)\b)", re.IGNORECASE)
# Text for other programs: POV-Ray's scenes, elements, styles.
code_of_others = re.compile(r"\{(?![}:\d])|</?\w|\w=\"|^\s*#")
not_of_the_program = re.compile(r"_(test|bench|fuzz)\.(cpp|h)$|/test_[^/]*$")
riddles = re.compile(r"\b(but for|all but)\b", re.IGNORECASE)
end_of_sentence = re.compile(r"(?<=[.!?])\s+(?=[A-Z\"(`])")
comment = re.compile(r"\s*(///?<?|#)(?:\s(.*)|)$")
part_of_list = re.compile(r"[-*|] |\d+\. ")
comment_behind_code = re.compile(r".*\S\s+///<\s(.*)$")
code_like = re.compile(r"\s*#\s*(include|define|undef|if|ifdef|ifndef|elif|else|endif|pragma|error|!)")
generated = ("reports/published/", "reports/snapshots/")
samples = ("harness/setup/long_sentence/", "harness/setup/old_table/", "harness/courses/", "build/")
# With the licence of the data's authors, in their words; and the page that lists words to avoid.
exempt = ("scenes/sky/sky_hosek_wilkie_table.cpp", "scenes/sky/sun_irradiance_table.cpp", "harness/oracles/sky_oracle.py",
          "docs/style.md")


def words(sentence):
    return re.findall(r"[^\W_][\w'’%./-]*", sentence)


def plain(text):
    text = re.sub(r"<!--.*?-->", "", text)
    text = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`|&[a-z]+;", "CODE", text)
    return re.sub(r"[*_#>|]", " ", text)


def page_text(lines):
    """A paragraph's text on each of its lines; None for tables, headings, code and blank lines."""
    fenced = False
    for line in lines:
        if line.lstrip().startswith("```"):
            fenced = not fenced
            yield None, False
        elif fenced or not line.strip() or line.startswith(("    ", "|", "<", "!", "#", "---")):
            yield None, False
        else:
            item = re.sub(r"^\s*([-*]|\d+\.)\s+", "", line)
            yield item, item != line


def source_text(lines):
    """The text of comments; None elsewhere, and for lines that are indented: tables, commands, formulas."""
    mark = None
    for line in lines:
        whole = None if code_like.match(line) else comment.match(line)
        behind = comment_behind_code.match(line)
        if whole:
            text = None if not whole[2] or whole[2].startswith("  ") else whole[2]
            yield text, whole[1] != mark or bool(text and part_of_list.match(text))
            mark = whole[1]
        else:
            yield (behind[1], True) if behind else (None, False)
            mark = "///<" if behind else None


def passages(path, lines):
    """(line, text) of every paragraph or comment."""
    begin, run = 0, []
    for number, (text, begins) in enumerate(page_text(lines) if path.endswith(".md") else source_text(lines), 1):
        if run and (text is None or begins):
            yield begin, " ".join(run)
            run = []
        if text is not None:
            begin = begin if run else number
            run.append(text.strip())
    if run:
        yield begin, " ".join(run)


def messages_of(path, text):
    """(line, paragraph) of every message of the program itself."""
    if path.endswith((".cpp", ".h")) and not not_of_the_program.search(path):
        for line, message in messages(text):
            if not code_of_others.search(message):
                yield from ((line, paragraph) for paragraph in message.split("\n"))


def sentences(path, text):
    """(kind, line of the passage, place in it, text) of every sentence of three words or more."""
    kind = "pages" if path.endswith(".md") else "headers" if path.endswith(".h") else "sources"
    found = [(kind, *passage) for passage in passages(path, text.split("\n"))]
    for kind, begin, passage in found + [("messages", *message) for message in messages_of(path, text)]:
        for place, sentence in enumerate(end_of_sentence.split(" ".join(plain(passage).split()))):
            if len(words(sentence)) > 2:
                yield kind, begin, place, sentence


def complaint(kind, place, sentence):
    count = len(words(sentence))
    if count > most_words:
        return f"{count} words"
    if sentence.count(";") > 1:
        return "two semicolons"
    if kind != "pages" and place == 0 and (headless_message if kind == "messages" else headless).match(sentence):
        return "no noun first"
    return "a riddle" if riddles.search(sentence) else None


def mean_words(found):
    return sum(len(words(s)) for _, _, _, s in found) / max(1, len(found))


def problems_of(path, found):
    wrong = [(line, complaint(kind, place, s), s) for kind, line, place, s in found]
    problems = [f"{path}:{line}: {why}: {s[:120]}" for line, why, s in wrong if why]
    mean = mean_words(found)
    if path.endswith(".md") and len(found) > 10 and mean > most_mean_words:
        problems.append(f"{path}:1: a mean of {mean:.1f} words a sentence, more than {most_mean_words}")
    return problems


def summary_of(everything):
    """The mean of pages, headers and messages, and the longest sentence with its place; and the means that are too long."""
    lines, problems = [], []
    for kind in ("pages", "headers", "messages"):
        found = [(path, sentence) for path, sentence in everything if sentence[0] == kind]
        if not found:
            continue
        mean = mean_words([sentence for _, sentence in found])
        path, (_, line, _, longest) = max(found, key=lambda row: len(words(row[1][3])))
        lines.append(f"{kind}: {len(found)} sentences, mean {mean:.1f} words, longest {len(words(longest))}: {path}:{line}: {longest}")
        if mean > most_mean_words:
            problems.append(f"{kind}: a mean of {mean:.1f} words a sentence, more than {most_mean_words}")
    return lines, problems


def texts_below(root):
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.suffix in (".md", ".h", ".cpp", ".py", ".sh", ".cmake", ".js") and not name.startswith(generated + samples + exempt):
            yield name, path


def main(arguments):
    whole = len(arguments) == 1 and Path(arguments[0]).is_dir()
    files = texts_below(Path(arguments[0])) if whole else [(a, Path(a)) for a in arguments]
    problems, everything = [], []
    for name, path in files:
        found = list(sentences(name, path.read_text(errors="replace")))
        wrong = problems_of(name, found)
        problems += wrong
        everything += [(name, sentence) for sentence in found]
        if not whole:
            print(f"{name}: {len(found)} sentences, {mean_words(found):.1f} words a sentence, {len(wrong)} to change")
    lines, too_long = summary_of(everything)
    return tell(problems + too_long, "\n".join([f"{len(everything)} sentences"] + (lines if whole else [])))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
