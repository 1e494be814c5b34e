"""Hooks of the site's build. Pages link to files of the repository by relative paths, which work on a code host. The
site has only the pages, so a link that leaves docs/ becomes the file's address on the code host. An image outside of
docs/ is copied into the site. A link to a file that does not exist is a warning, which `--strict` makes an error."""
import logging
import os
import re

from mkdocs.structure.files import File

IMAGES = "outside"  # the site's folder for images that lie outside of docs/

log = logging.getLogger("mkdocs.hooks.links")
FENCE = re.compile(r"^ {0,3}(```+|~~~+)")
CODE_SPAN = re.compile(r"(?<!`)(`+)(?!`).*?(?<!`)\1(?!`)")
LINK = re.compile(r"(?P<before>\]\(<?|^\[[^\]]+\]:\s+<?)(?P<target>[^)\s>]+)", re.MULTILINE)
IMAGE = re.compile(r"!\[[^\]]*\]\(<?$")
HAS_SCHEME = re.compile(r"^[a-z][a-z0-9+.-]*:|^#|^/", re.IGNORECASE)


def prose_and_code(markdown):
    """Lines of a page with whether they are prose, not fenced code."""
    fence = None
    for line in markdown.split("\n"):
        match = FENCE.match(line)
        if fence is None and match:
            fence = match.group(1)
            yield line, False
        elif fence is not None:
            if match and match.group(1).startswith(fence) and line.strip() == match.group(1):
                fence = None
            yield line, False
        else:
            yield line, True


def replace_links(markdown, replace):
    """The page with `replace(target, is_image)` in place of every link's target outside of code."""

    def in_line(line):
        spans = []

        def hide(match):
            spans.append(match.group(0))
            return f"\0{len(spans) - 1}\0"

        def changed(match):
            is_image = IMAGE.search(hidden[: match.end("before")]) is not None
            return match.group("before") + replace(match.group("target"), is_image)

        hidden = CODE_SPAN.sub(hide, line)
        return re.sub(r"\0(\d+)\0", lambda match: spans[int(match.group(1))], LINK.sub(changed, hidden))

    return "\n".join(in_line(line) if prose else line for line, prose in prose_and_code(markdown))


def outside(target, page_uri, config):
    """Path in the repository and fragment of a link out of the site's pages; None for every other link."""
    if HAS_SCHEME.match(target):
        return None
    path, _, fragment = target.partition("#")
    docs = os.path.realpath(config.docs_dir)
    full = os.path.normpath(os.path.join(docs, os.path.dirname(page_uri), path))
    from_docs = os.path.relpath(full, docs)
    if not from_docs.startswith("..") and not from_docs.startswith("examples"):
        return None
    return os.path.relpath(full, os.path.dirname(docs)), fragment


def on_files(files, config):
    """Adds the images outside of docs/ that pages show."""
    repository = os.path.dirname(os.path.realpath(config.docs_dir))

    for page in files.documentation_pages():

        def add(target, is_image):
            found = outside(target, page.src_uri, config)
            if is_image and found:
                path = os.path.join(repository, found[0])
                uri = f"{IMAGES}/{found[0]}"
                if os.path.isfile(path) and files.get_file_from_path(uri) is None:
                    files.append(File.generated(config, uri, abs_src_path=path))
            return target

        replace_links(page.content_string, add)
    return files


def on_page_markdown(markdown, page, config, files):
    repository = os.path.dirname(os.path.realpath(config.docs_dir))

    def address(target, is_image):
        found = outside(target, page.file.src_uri, config)
        if not found:
            return target
        path, fragment = found
        full = os.path.join(repository, path)
        if path.startswith("..") or not os.path.exists(full):
            log.warning("Doc file '%s' links to '%s', which the repository has not", page.file.src_uri, target)
        if is_image:
            return os.path.relpath(f"{IMAGES}/{path}", os.path.dirname(page.file.src_uri) or ".")
        kind = "tree" if os.path.isdir(full) else "blob"
        return f"{config.repo_url}/{kind}/main/{path}" + (f"#{fragment}" if fragment else "")

    return replace_links(markdown, address)
