# SPDX-License-Identifier: BSD-3-Clause
"""Compares what the pages say of options with what the programs and the headers say of them."""
import re
import subprocess
from decimal import Decimal

from program_options import find_range, read_setters, short_number

# Every program has these; a page may pass them over.
COMMON = {"help", "version"}
# Values that the headers call by a name and the command tool by a number.
NUMBERED = {"curve": "1", "surface": "2"}


def spelled_options(cell):
    """Long names and letters of the options in a table's cell."""
    spans = " ".join(re.findall(r"`([^`]*)`", cell))
    return re.findall(r"(?<!\S)--([a-z-]+)", spans), re.findall(r"(?<!\S)-(\w)\b", spans)


def check_table(page, options, shared):
    """The page's tables of options name every option, and no other, with its letter, default and range.

    A row about those of pcl_pds_recon speaks for all options that are the same there; shared has their names.
    """
    letters = {option.letter: option for option in options.values() if option.letter}
    documented = {}
    rows = page.tables("option")
    passed_over = set(COMMON)
    if any("pcl_pds_recon" in row[2] for row in rows):
        passed_over |= shared
    for row in rows:
        names, short_names = spelled_options(row[0])
        for name in names:
            if name not in options:
                yield f"{page.name}: there is no option --{name}"
        for letter in short_names:
            if letter not in letters:
                yield f"{page.name}: there is no option -{letter}"
        found = [options[name] for name in names if name in options]
        found += [letters[letter] for letter in short_names if letter in letters]
        for option in found:
            documented[option.name] = row
            if option.name in names and option.letter and option.letter not in short_names:
                yield f"{page.name}: --{option.name} is also -{option.letter}"
    for name, option in options.items():
        if name in passed_over:
            continue
        if name in documented:
            yield from check_row(page, option, documented[name])
        else:
            yield f"{page.name}: says nothing of --{name}"


def check_row(page, option, row):
    default, words = row[1], row[2]
    is_number = re.fullmatch(r"-?\d.*", default)
    if (option.default or is_number) and default != option.default:
        yield f"{page.name}: --{option.name} has the default '{option.default}', not '{default}'"
    if find_range(words) != option.range:
        yield f"{page.name}: --{option.name} has the range {option.range}, not {find_range(words)}"


def check_headings(page, options):
    """Every option has a heading of the page."""
    named = {name for heading in page.headings() for name in re.findall(r"--([a-z-]+)", heading)}
    yield from (f"{page.name}: there is no option --{name}" for name in sorted(named - options.keys()))
    yield from (f"{page.name}: --{name} has no heading" for name in sorted(options.keys() - named - COMMON))


def check_settings(settings, options):
    """The fields, the comments of the setters and the programs agree."""
    for setting in settings.values():
        option = options.get(setting.field.replace("_", "-"))
        if option and option.default != NUMBERED.get(setting.default, setting.default):
            yield f"options.h: {setting.field} is {setting.default}, but --{option.name} {option.default}"
        if option and setting.range and option.range != setting.range:
            yield f"options.h: the range of {setting.field} is {setting.range}, but of --{option.name} {option.range}"
        if not setting.setter:
            yield f"poisson_disk_reconstruction.h: nothing sets {setting.field}"
            continue
        comment = setting.setter_comment
        match = re.search(r"default (-?[\d.]*\d)", comment) or re.search(r"([\w.:]+) \(default\)", comment)
        said = short_number(match.group(1)) if match else "nothing"
        if said != setting.default:
            yield f"poisson_disk_reconstruction.h: {setting.setter} says default {said}, but it is {setting.default}"
        if setting.range and find_range(comment) not in (None, setting.range):
            yield f"poisson_disk_reconstruction.h: {setting.setter} has the range {setting.range}"


def check_setter_table(page, root, settings):
    """The page's table of setters names every setter, and no other, with its default and range."""
    rows = {re.sub(r"\W", "", row[0]): row for row in page.tables("setter")}
    setters = read_setters(root)
    yield from (f"{page.name}: says nothing of {name}" for name in setters if name not in rows)
    yield from (f"{page.name}: there is no setter {name}" for name in rows if name not in setters)
    for setting in settings.values():
        if setting.setter not in rows:
            continue
        _, default, words = rows[setting.setter]
        if default.strip("`") != setting.default:
            yield f"{page.name}: {setting.setter} has the default {setting.default}, not {default}"
        if setting.range and find_range(words) not in (None, setting.range):
            yield f"{page.name}: {setting.setter} has the range {setting.range}, not {find_range(words)}"


def check_ranges(program, options):
    """The program takes both ends of every range and refuses what is just beyond. A missing input ends each run."""
    bad_usage = 2
    for option in options.values():
        if not option.range:
            continue
        low, high = map(Decimal, option.range)
        step = Decimal(1) if option.argument.startswith("N") else Decimal("0.001")
        for value, is_good in ((low - step, False), (low, True), (high, True), (high + step, False)):
            command = [program, f"--{option.name}={value}", "no_such_file.ply", "mesh.ply"]
            status = subprocess.run(command, capture_output=True, check=False).returncode
            if (status != bad_usage) != is_good:
                yield f"--{option.name}: the help has the range {option.range}, but {value} gives exit status {status}"


def check_command_lines(page, programs):
    """Command lines of the page use options that their program has."""
    for line in page.command_lines():
        for part in re.split(r"[|;]|&&", line.split("#")[0]):
            words = part.replace("'", " ").split()
            called = [i for i, word in enumerate(words) if word.split("/")[-1] in programs]
            if not called or not re.search(r"\s", part.strip()):
                continue
            options = programs[words[called[0]].split("/")[-1]]
            for word in words[called[0] + 1 :]:
                match = re.fullmatch(r"--([a-z][a-z-]*)(=.*)?", word)
                if match and match.group(1) not in options.keys() | COMMON:
                    yield f"{page.name}: '{line}': there is no option --{match.group(1)}"


def option_table(settings, options):
    """Options of the command tool, and the same for C++, as the lines of a table."""
    lines = ["| option | default | range | `pds::Options` | PCL class |", "| --- | --- | --- | --- | --- |"]
    for name, option in options.items():
        if name in COMMON:
            continue
        spelled = f"`-{option.letter}`, " if option.letter else ""
        spelled += f"`--{name} {option.argument}`" if option.argument else f"`--{name}`"
        setting = settings.get(name.replace("-", "_"))
        in_cpp = (f"`{setting.field}`", f"`{setting.setter}`") if setting else ("", "")
        spelled = spelled.replace("|", "\\|")
        lines.append(f"| [{spelled}](#{anchor(option)}) | {option.default or ''} | {' ... '.join(option.range or ())} | {in_cpp[0]} | {in_cpp[1]} |")
    return "\n".join(lines) + "\n"


def anchor(option):
    """The name that GitHub gives to the heading of an option."""
    letter = f"-{option.letter} " if option.letter else ""
    argument = f" {option.argument}" if option.argument else ""
    return re.sub(r"[^\w\- ]", "", f"{letter}--{option.name}{argument}".lower()).replace(" ", "-")
