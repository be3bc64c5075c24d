# SPDX-License-Identifier: BSD-3-Clause
"""What a program says of its options, and what the headers say of theirs."""
import re
import subprocess
from dataclasses import dataclass
from typing import Optional

NUMBER = r"-?\d+(?:\.\d+)?"
RANGE = re.compile(rf"({NUMBER}) \.\.\. ({NUMBER})")


@dataclass
class Option:
    name: str
    letter: str
    argument: str
    help: str

    @property
    def default(self):
        match = re.search(r"\(default ([^)]+)\)", self.help)
        return match.group(1) if match else None

    def is_same_as(self, other):
        return other is not None and self.help.split() == other.help.split() and self.letter == other.letter

    @property
    def range(self):
        return find_range(self.help)


def find_range(text):
    match = RANGE.search(text)
    return match.groups() if match else None


# '  -k, --name=X  help', '      --name  help' and Boost's '  -k [ --name ] X  help'
OPTION_LINE = re.compile(r"^ {2,6}(?:-(\w)(?:, | \[ ))?--([a-z-]+)(?: \])?(?:[= ](\S+))?(?:  +| )(.*)$")


def read_options(program):
    """The options that the program lists for --help, by name."""
    text = subprocess.run([program, "--help"], check=True, capture_output=True, text=True).stdout
    options = {}
    last = None
    for line in text.splitlines():
        match = OPTION_LINE.match(line)
        if match:
            letter, name, argument, words = match.groups()
            last = Option(name, letter or "", argument or "", words)
            options[name] = last
        elif last and line.startswith(" " * 12):
            last.help += " " + line.strip()
        else:
            last = None
    return options


def short_number(text):
    """15.0 as 15, GeodesicSolver::dijkstra as dijkstra."""
    text = text.split("::")[-1]
    return re.sub(r"\.0+$", "", text)


@dataclass
class Setting:
    """A field of pds::Options."""

    field: str
    default: str
    range: Optional[tuple]
    setter: str = ""
    setter_comment: str = ""


def read_settings(root):
    """The fields of pds::Options, by name, each with the setter of the PCL class that stores it."""
    include = root / "pcl_pds_recon/include"
    header = (include / "pcl_pds_recon/options.h").read_text()
    body = re.search(r"\nstruct Options\n\{\n(.*?)\n\};", header, re.DOTALL).group(1)
    settings = {}
    for line in re.finditer(r"^  [\w:]+ (\w+) = ([^;]+);(.*)$", body, re.MULTILINE):
        field, default, comment = line.groups()
        before = body[: line.start()].rstrip()
        if before.endswith("*/"):
            comment = before[before.rindex("/**") :]
        settings[field] = Setting(field, short_number(default), find_range(comment))

    text = (include / "pcl/surface/poisson_disk_reconstruction.h").read_text()
    pattern = r"/\*\*((?:(?!\*/).)*)\*/\s*void (set\w+)\([^)]*\) \{ options_\.(\w+) = "
    for comment, setter, field in re.findall(pattern, text, re.DOTALL):
        settings[field].setter = setter
        settings[field].setter_comment = re.sub(r"\s*\n\s*\* ?", " ", comment)
    return settings


def read_setters(root):
    """The names of all setters of the PCL class."""
    text = (root / "pcl_pds_recon/include/pcl/surface/poisson_disk_reconstruction.h").read_text()
    return re.findall(r"\n  void (set\w+)\(", text)
