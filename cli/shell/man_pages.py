"""Writes the manual pages burin.1, burin-render.1 ... of the program's own help.

    man_pages.py BURIN FOLDER
"""

import os
import re
import subprocess
import sys
from html.parser import HTMLParser

PAGE_OF_VIEW = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "web", "page", "view.html")

EXIT_STATUS = {
    "0": "All is done.",
    "1": "Bad input: a file that cannot be read or written, or that is wrong. The message names the file and what to do.",
    "2": "Bad arguments.",
    "130": "Interrupted. There is no partial file.",
}
# Of a command that goes on until a signal ends it.
EXIT_STATUS_OF_VIEW = {
    "0": "Ctrl-C or another signal ended it, once it had printed the address of its page.",
    "1": "Bad input: a file that cannot be read, or that is wrong, or a port that is in use. The message says what to do.",
    "2": "Bad arguments.",
    "130": "Interrupted before it had printed the address.",
}
ENVIRONMENT = {
    "BURIN_STYLES": "Folders of style sheets, separated by colons.",
    "BURIN_KERNELS": "The vector instructions to use at most: baseline, avx2 or avx512. Pictures do not depend on it.",
}
FILES = {
    "PREFIX/share/doc/burin": "The pages docs/NAME.md that messages name, and the scenes that their examples draw. PREFIX "
    "is where Burin was installed: /usr, if by packages.",
    "~/.config/burin/styles/NAME.toml": "Style sheets of the user, which --style finds by their name.",
}

ABOUT = """Burin draws 3D models as lines: silhouettes, creases, borders and intersections, with hidden lines removed or
dashed, and anti-aliased. It reads OBJ, PLY, STL, OFF, glTF and GLB, and scenes of its own in TOML. It writes PNG, TIFF
and EXR with layers, and SVG, PDF and DXF. The same input gives the same bytes on every run."""

EXAMPLES = {
    "render": [
        ("A model as it is", "burin render model.obj -o lines.png"),
        ("From a place, in the look of a style sheet", "burin render model.obj --eye 3,2,5 --style pencil -o pencil.png"),
        ("A vector drawing with dashed hidden lines", "burin render model.obj --hidden dashed -o drawing.svg"),
        ("Three views and an isometric one on A3", "burin render part.stl --page iso128 --views front,top,right,iso -o part.pdf"),
        ("A hundred frames with layers", "burin render shot.toml -f 1-100 -o shot.####.exr --skip-existing"),
    ],
    "restyle": [
        ("Keep the lines, and draw them again", "burin render scene.toml --style comic --save-lines scene.lines -o comic.png"),
        ("", "burin restyle scene.lines --style comic --set style.width=5 -o bold.png"),
    ],
    "compare": [("Two methods against the ground truth", "burin compare scene.toml -o comparison --methods abuffer,gbuffer")],
    "explain": [("Why there is a line in a pixel", "burin explain model.obj --pixel 740,389")],
    "info": [("What is in a file", "burin info model.glb")],
    "styles": [("A sheet to begin your own with", "burin styles technical > mine.toml")],
    "submit": [("To a farm, with a limit of time", "burin submit shot.toml -f 1-100 -o shot.####.exr -- --time=10")],
    "assemble": [("Bands to a picture", "burin assemble -o whole.exr band_0.exr band_1.exr")],
    "view": [("Look at a model in the browser", "burin view model.obj")],
}


def roff(text: str) -> str:
    """Text as roff has it; `words` in backticks are bold."""
    text = text.replace("\\", "\\e").replace("-", "\\-")
    text = re.sub(r"`([^`]+)`", r"\\fB\1\\fR", text)
    return re.sub(r"^([.'])", r"\\&\1", text, flags=re.M)


class Help:
    """The parts of what `burin COMMAND --help` prints."""

    def __init__(self, text: str):
        lines = text.rstrip("\n").split("\n")
        self.summary = lines[0]
        self.usage = lines[1].removeprefix("Usage: ")
        self.sections: dict[str, list[tuple[str, str]]] = {}
        self.footer: list[str] = []
        rows = None
        for line in lines[2:]:
            heading = re.fullmatch(r"([A-Z][a-z]+):", line)
            if heading:
                rows = self.sections.setdefault(heading.group(1), [])
            elif rows is not None and (row := re.fullmatch(r"  (\S.*?)(?:  +(\S.*))?", line)):
                rows.append((row.group(1), row.group(2) or ""))
            elif rows and line.startswith(" " * 20):  # behind a name that is too long for its column
                name, help_text = rows[-1]
                rows[-1] = (name, (help_text + " " + line.strip()).strip())
            elif line:
                self.footer.append(line)


def option_name(declared: str) -> str:
    """"-r,--size TEXT" as "-r, --size VALUE", in bold and italics."""
    names, _, value = declared.partition(" ")
    parts = [f"\\fB{roff(name)}\\fR" for name in names.split(",")]
    value = value.replace("REQUIRED", "").strip()
    return ", ".join(parts) + (" \\fI" + roff(value.replace("TEXT", "VALUE")) + "\\fR" if value else "")


def rows_of(rows: dict[str, str]) -> list[str]:
    lines = []
    for name, text in rows.items():
        lines += [".TP", f".B {roff(name)}", roff(text)]
    return lines


def synopsis(usage: str) -> str:
    words = usage.split(" ")
    bold = [w for w in words if w.islower()]
    return "\\fB" + roff(" ".join(bold)) + "\\fR " + " ".join(f"\\fI{roff(w)}\\fR" for w in words[len(bold):])


class KeysOfPage(HTMLParser):
    """What the page of `burin view` says of its keys and its mouse: the rows of its list."""

    def __init__(self):
        super().__init__()
        self.rows: list[dict[str, str]] = []
        self.part = ""
        with open(PAGE_OF_VIEW, encoding="utf-8") as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        if tag == "dt":
            self.rows.append({"dt": "", "dd": ""})
        if tag in ("dt", "dd"):
            self.part = tag

    def handle_endtag(self, tag):
        if tag == self.part:
            self.part = ""

    def handle_data(self, data):
        if self.part:
            self.rows[-1][self.part] += data


def page(name: str, version: str, parsed: Help, others: list[str], examples: list[tuple[str, str]], about: str,
         keys: dict[str, str], exit_status: dict[str, str]) -> str:
    lines = [
        '.\\" Made of the program\'s help.',
        f'.TH {name.upper()} 1 "" "{version}" "Burin"',
        ".SH NAME",
        f"{roff(name)} \\- {roff(parsed.summary.removeprefix('burin ').rstrip('.'))}",
        ".SH SYNOPSIS",
        synopsis(parsed.usage),
    ]
    if about:
        lines += [".SH DESCRIPTION", roff(about)]
    commands = parsed.sections.get("Subcommands", [])
    if commands:
        lines.append(".SH COMMANDS")
        for command, text in commands:
            lines += [".TP", f".B {roff(command)}", f"{roff(text)}; see", f".BR {roff(name)}\\-{roff(command)} (1)"]
    if "Positionals" in parsed.sections:
        lines.append(".SH ARGUMENTS")
        for declared, text in parsed.sections["Positionals"]:
            lines += [".TP", f".I {roff(declared.split(' ')[0])}", roff(text)]
    lines.append(".SH OPTIONS")
    for declared, text in parsed.sections.get("Options", []):
        lines += [".TP", option_name(declared), roff(text)]
        if "REQUIRED" in declared:
            lines.append("It must be given.")
    if parsed.footer:
        lines += [".SH NOTES"] + [roff(line) for line in parsed.footer]
    if keys:
        lines += [".SH KEYS AND MOUSE", "On the page:"] + rows_of(keys)
    if examples:
        lines.append(".SH EXAMPLES")
        for text, command in examples:
            lines += ([".PP", roff(text) + ":"] if text else []) + [".PP", ".nf", ".RS", roff(command), ".RE", ".fi"]
    lines += [".SH EXIT STATUS"] + rows_of(exit_status)
    lines += [".SH ENVIRONMENT"] + rows_of(ENVIRONMENT)
    lines += [".SH FILES"] + rows_of(FILES)
    lines += [".SH SEE ALSO", ", ".join(f"\\fB{roff(other)}\\fR(1)" for other in others)]
    return "\n".join(lines) + "\n"


def main() -> None:
    burin, folder = sys.argv[1:]

    def output_of(*arguments: str) -> str:
        return subprocess.run([burin, *arguments], check=True, capture_output=True, text=True).stdout

    version = "burin " + output_of("--version").strip().split(" ")[-1]
    program = Help(output_of("--help"))
    commands = [name for name, _ in program.sections["Subcommands"]]
    names = ["burin"] + [f"burin-{command}" for command in commands]
    pages = {"burin": page("burin", version, program, names[1:], EXAMPLES["render"][:1], ABOUT, {}, EXIT_STATUS)}
    for command in commands:
        name = f"burin-{command}"
        others = [other for other in names if other != name]
        is_view = command == "view"
        pages[name] = page(name, version, Help(output_of(command, "--help")), others, EXAMPLES.get(command, []), "",
                           {row["dt"]: row["dd"] for row in KeysOfPage().rows} if is_view else {},
                           EXIT_STATUS_OF_VIEW if is_view else EXIT_STATUS)
    os.makedirs(folder, exist_ok=True)
    for name, text in pages.items():
        with open(os.path.join(folder, name + ".1"), "w", encoding="utf-8") as file:
            file.write(text)


main()
