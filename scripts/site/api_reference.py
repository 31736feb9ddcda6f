"""The reference of the library as a page: what burin/burin.h says of each function, struct and constant, and the
classes of burin/burin.hpp without the bodies of their functions.

    api_reference.py BURIN_H BURIN_HPP > page.md
"""

import re
import sys

COMMENT = re.compile(r"/\*\*(?!<)\s*(.*?)\s*\*/", re.S)
FIELD_COMMENT = re.compile(r"/\*\*<\s*(.*?)\s*\*/", re.S)
NAME = re.compile(r"\b((?:burin|BURIN)_\w+)(?:\(\))?")


def text_of(comment: str) -> str:
    """A comment without its stars; what is indented stays as it is."""
    lines = [re.sub(r"^\s*\* ?", "", line) if line.lstrip().startswith("*") else line.strip() for line in comment.split("\n")]
    return "\n".join(line.rstrip() for line in lines).strip("\n")


def linked(text: str, names: set[str], own: str = "") -> str:
    """Names of the interface become links to where they are explained."""
    def link(match: re.Match) -> str:
        name = match.group(1)
        if name not in names:
            return match.group(0)
        return f"`{match.group(0)}`" if name == own else f"[`{match.group(0)}`](#{name})"

    parts = re.split(r"(`[^`]*`)", text)  # what is code already stays
    return "".join(p if p.startswith("`") else NAME.sub(link, p) for p in parts)


def paragraphs(comment: str) -> str:
    """Blocks that are indented by four are tables of the comment."""
    blocks: list[list[str]] = [[]]
    is_code = False
    for line in text_of(comment).split("\n"):
        if line.startswith("    ") != is_code and line:
            blocks.append([])
            is_code = not is_code
        elif not line and not is_code:
            blocks.append([])
            continue
        blocks[-1].append(line)
    return "\n\n".join("\n".join(block) for block in blocks if block)


class Entry:
    """Declarations that one comment explains."""

    def __init__(self, comment: str, code: str):
        self.comment = comment
        self.codes = [code]

    def names(self) -> list[str]:
        return [name for code in self.codes for name in declared_names(code)]


def declared_names(code: str) -> list[str]:
    """What a declaration declares, and for an enum its constants."""
    bare = re.sub(r"/\*.*?\*/", "", code, flags=re.S)
    if found := re.match(r"#define (\w+)", bare):
        return [found.group(1)]
    if found := re.match(r"enum (\w+)", bare):
        return [found.group(1)] + re.findall(r"\b(BURIN_\w+)\b", bare)
    if found := re.match(r"typedef struct (\w+)", bare):
        return [found.group(1)]
    if found := re.match(r"typedef .*?\(\*(\w+)\)", bare):
        return [found.group(1)]
    if found := re.match(r"BURIN_API [^(]*?(\w+)\(", bare):
        return [found.group(1)]
    raise SystemExit(f"api_reference: what is this? {code}")


def statement_at(text: str, at: int) -> int:
    """The end of the declaration that begins there: behind its semicolon, comments and braces left out."""
    depth = 0
    while at < len(text):
        if text.startswith("/*", at):
            at = text.index("*/", at) + 2
            continue
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
        if text[at - 1] == ";" and depth == 0:
            return at
    raise SystemExit("api_reference: a declaration does not end")


def read(header: str) -> list[tuple[str, list[Entry]]]:
    """Sections with their entries, in the order of the header."""
    body = header[header.index("/* ---- "):header.rindex("#ifdef __cplusplus")]
    sections: list[tuple[str, list[Entry]]] = []
    comment, at = "", 0
    while at < len(body):
        rest = body[at:]
        if heading := re.match(r"/\* ---- (.*?) ---- \*/", rest):
            sections.append((heading.group(1), []))
            at += heading.end()
        elif found := COMMENT.match(rest):
            comment = found.group(1)
            at += found.end()
        elif found := re.match(r"/\*.*?\*/|\s+", rest, re.S):
            at += found.end()
        else:
            end = at + (rest.index("\n") if rest.startswith("#") else statement_at(rest, 0))
            entries = sections[-1][1]
            if comment:
                entries.append(Entry(comment, body[at:end]))
            else:  # belongs to what stands before it
                entries[-1].codes.append(body[at:end])
            comment, at = "", end
    return sections


def fields_of(code: str) -> list[tuple[str, str]]:
    """Fields of a struct, constants of an enum: declaration and comment."""
    if "{" not in code:
        return []
    body = code[code.index("{") + 1:code.rindex("}")]
    fields, at, before = [], 0, ""
    while at < len(body):
        rest = body[at:]
        if found := FIELD_COMMENT.match(rest):
            if fields:
                fields[-1] = (fields[-1][0], text_of(found.group(1)))
            at += found.end()
        elif found := COMMENT.match(rest):
            before = text_of(found.group(1))
            at += found.end()
        elif found := re.match(r"[\s,]+", rest):
            at += found.end()
        else:
            found = re.match(r"[^;{]*;" if not code.startswith("enum") else r"[^,/}]+", rest, re.S)
            fields.append((" ".join(found.group(0).rstrip(";").split()), before))
            before, at = "", at + found.end()
    return fields


def cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def closing(text: str, at: int) -> int:
    """The place behind the brace that closes the one at `at`."""
    depth = 0
    while True:
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        at += 1
        if depth == 0:
            return at


def members_of(body: str) -> list[str]:
    """Public members of a class, with their comments, functions as declarations."""
    lines, at, is_public = [], 0, not re.match(r"\s*(public|private):", body)
    while at < len(body):
        rest = body[at:]
        if found := re.match(r"\s*(public|private|protected):", rest):
            is_public = found.group(1) == "public"
            at += found.end()
        elif found := re.match(r"\s*///<? ?(.*)\n", rest):
            if is_public:
                if rest.lstrip().startswith("///<") and lines:
                    lines[-1] += "  // " + found.group(1)
                else:
                    lines.append("    // " + found.group(1))
            at += found.end()
        elif found := re.match(r"\s+", rest):
            at += found.end()
        else:
            end, parentheses = at, 0
            while True:
                sign = body[end]
                parentheses += {"(": 1, ")": -1}.get(sign, 0)
                if sign == ";" and parentheses == 0:
                    text, at = body[at:end], end + 1
                    break
                if sign == "{":
                    if parentheses == 0 and re.search(r"\)( const| noexcept| override)*( : .*)?$", body[at:end].rstrip(), re.S):
                        text, at = body[at:end], closing(body, end)
                        break
                    end = closing(body, end) - 1
                end += 1
            text = re.sub(r"\)( const)?( noexcept)? : .*", r")\1\2", " ".join(re.sub(r"///?<?.*", "", text).split()))
            if is_public and not re.search(r"= (delete|default)$", text):
                lines.append("    " + text.strip() + ";")
    return lines


def classes_of(header: str) -> list[tuple[str, str, str]]:
    """Name, comment and declaration of each class."""
    classes = []
    for found in re.finditer(r"((?:^///.*\n)+)^(class|struct) (\w+)[^{;]*\{", header, re.M):
        body = header[found.end():closing(header, found.end() - 1) - 1]
        comment = " ".join(line.lstrip("/ ") for line in found.group(1).strip().split("\n"))
        classes.append((found.group(3), comment, "\n".join([f"{found.group(2)} {found.group(3)} {{", *members_of(body), "};"])))
    return classes


def page(header: str, cpp_header: str) -> str:
    sections = read(header)
    names = {name for _, entries in sections for entry in entries for name in entry.names()}
    rules = text_of(header[header.index("/*") + 2:header.index("*/")])
    lines = ["# API reference", "", "Made of the comments of `burin/burin.h` and `burin/burin.hpp`; [the library](library.md) shows how it is used.", ""]
    lines.append(linked(rules[rules.index("Rules"):], names))
    for title, entries in sections:
        lines += ["", f"## {title[0].upper()}{title[1:]}", ""]
        for entry in entries:
            heads = [declared_names(code)[0] for code in entry.codes]
            for name in dict.fromkeys(heads):
                lines += [f"### {name} {{#{name}}}", ""]
            code = "\n".join(re.sub(r"\s*/\*\*.*?\*/", "", c, flags=re.S).removeprefix("BURIN_API ").replace("\nBURIN_API ", "\n") for c in entry.codes)
            lines += ["```c", code, "```", "", linked(paragraphs(entry.comment), names, heads[-1]), ""]
            fields = [field for c in entry.codes for field in fields_of(c)]
            if fields:
                lines += ["| | |", "|---|---|"]
                for declaration, comment in fields:
                    anchor = re.match(r"BURIN_\w+", declaration)
                    mark = f'<a id="{anchor.group(0)}"></a>' if anchor else ""
                    lines.append(f"| {mark}`{cell(declaration)}` | {linked(cell(comment), names)} |")
                lines.append("")
    lines += ["", "## In C++", "", "What `burin/burin.hpp` has in the namespace `burin`; calls that fail throw `burin::Error`.", ""]
    for name, comment, code in classes_of(cpp_header):
        lines += [f"### burin::{name} {{#burin::{name}}}", "", linked(comment, names), "", "```cpp", code, "```", ""]
    text = "\n".join(lines) + "\n"
    return re.sub(r"(?<!\]\()(?<![\w\[])docs/([\w/-]+)\.md", r"[\1](\1.md)", text)  # pages that comments name


if __name__ == "__main__":
    texts = []
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            texts.append(file.read())
    print(page(*texts), end="")
