# SPDX-License-Identifier: BSD-3-Clause
"""What the checks need to know of a Markdown page: tables, code, links, headings, blocks made from other files."""
import re
from pathlib import Path

GENERATED = re.compile(r"(<!-- generated: (\S+)((?: \S+)*) -->\n)(.*?)(<!-- end -->)", re.DOTALL)
FENCE = re.compile(r"^```(\S*)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
INDENTED = re.compile(r"(?:^    \S.*\n?)+", re.MULTILINE)


class Page:
    def __init__(self, path, root):
        self.path = path
        self.name = str(path.relative_to(root))
        self.text = path.read_text()

    def tables(self, first_column):
        """The rows, as lists of cells, of every table whose first column is called so."""
        rows = []
        inside = False
        for line in self.text.splitlines():
            if not line.startswith("|"):
                inside = False
                continue
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            if inside and not set(line) <= set("|- :"):
                rows.append(cells)
            elif cells[0] == first_column:
                inside = True
        return rows

    def without_code(self):
        return re.sub(r"`[^`\n]*`", "", INDENTED.sub("", FENCE.sub("", self.text)))

    def links(self):
        """Targets of links and pictures."""
        return re.findall(r"\]\(([^)\s]+)\)", self.without_code())

    def anchors(self):
        """The names of the headings, as GitHub makes them."""
        text = FENCE.sub("", self.text)
        headings = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
        words = [re.sub(r"[^\w\- ]", "", heading.strip().lower()) for heading in headings]
        return {word.replace(" ", "-") for word in words}

    def headings(self):
        return re.findall(r"^#+ (.*)$", FENCE.sub("", self.text), re.MULTILINE)

    def command_lines(self):
        """Lines of shell code, continued ones joined."""
        blocks = [code for language, code in FENCE.findall(self.text) if language in ("", "sh", "bash")]
        blocks += INDENTED.findall(FENCE.sub("", self.text))
        return [line.strip() for block in blocks for line in block.replace("\\\n", " ").splitlines()]

    def code_outside_blocks(self, language):
        """Code of a language that is not made from another file."""
        return [code for found, code in FENCE.findall(GENERATED.sub("", self.text)) if found == language]

    def fill(self, makers):
        """The text with every generated block made anew; makers gives the function for each kind of block."""

        def remake(match):
            begin, kind, arguments, _, end = match.groups()
            return begin + makers[kind](*arguments.split()) + end

        return GENERATED.sub(remake, self.text)


def pages(root):
    """All pages of the project; what a build made is not among them."""
    found = [path for path in root.rglob("*.md") if "build" not in path.relative_to(root).parts[0]]
    return [Page(path, root) for path in sorted(found)]


def quote_file(root, name, part=None):
    """A block that shows a file, or the part of it between two lines '[part]', without its licence line."""
    text = (root / name).read_text()
    lines = [line for line in text.splitlines() if "SPDX-License-Identifier" not in line]
    if part is not None:
        marks = [i for i, line in enumerate(lines) if line.strip(" /#") == f"[{part}]"]
        if len(marks) != 2:
            raise ValueError(f"{name}: has {len(marks)} lines '[{part}]' instead of two, one before and one after")
        lines = lines[marks[0] + 1 : marks[1]]
        indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
        lines = [line[indent:] for line in lines]
    lines = [line for line in lines if not re.fullmatch(r"\s*(//|#) \[\S+\]", line)]
    language = {".cpp": "cpp", ".sh": "sh", ".txt": "cmake", ".ini": "ini"}[Path(name).suffix]
    return f"```{language}\n" + "\n".join(lines).strip("\n") + "\n```\n"
