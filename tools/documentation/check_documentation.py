#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that the documentation says what the code does; with --write makes the blocks anew that quote other files.

  check_documentation.py [--write] BUILD_DIR [PROJECT_DIR]

Each line of the output is a fault; the exit status is 1 if there is one.
"""
import argparse
import re
import sys
from pathlib import Path

import option_checks
import report_checks
from markdown import pages, quote_file
from program_options import read_options, read_settings

PROGRAMS = {
    "pcl_pds_recon": ("tools", "README.md"),
    "pcl_pds_compare": ("tools/compare", "docs/compare.md"),
    "pcl_pds_viewer": ("tools/viewer", "docs/viewer.md"),
}
LARGEST_PICTURE = 300_000  # bytes; a page with ten of them is still fast to open


def check_links(page, all_pages, root):
    anchors = {page.path: page.anchors() for page in all_pages}
    for link in page.links():
        if re.match(r"\w+:", link):
            continue
        name, _, anchor = link.partition("#")
        target = (page.path.parent / name).resolve() if name else page.path
        if not target.exists():
            yield f"{page.name}: links to {link}, which is not there"
        elif anchor and target in anchors and anchor not in anchors[target]:
            yield f"{page.name}: links to {link}, but there is no such heading"


def check_pictures(all_pages, root):
    shown = {(page.path.parent / link).resolve() for page in all_pages for link in page.links()}
    for picture in sorted((root / "docs").rglob("*.png")):
        if picture.resolve() not in shown:
            yield f"{picture.relative_to(root)}: no page shows it"
        if picture.stat().st_size > LARGEST_PICTURE:
            yield f"{picture.relative_to(root)}: has more than {LARGEST_PICTURE // 1000} kB"


def check_blocks(page, makers, write):
    """Blocks that quote other files are up to date, and no program stands outside of them."""
    text = page.fill(makers)
    if text != page.text:
        if write:
            page.path.write_text(text)
        else:
            yield f"{page.name}: a generated block is out of date; run tools/make_documentation.sh"
    for code in page.code_outside_blocks("cpp"):
        yield f"{page.name}: quotes no compiled file: {code.strip().splitlines()[0]}"


def check_build_options(page, root):
    declared = re.findall(r"^option\((PCL_PDS_RECON_\w+)", (root / "CMakeLists.txt").read_text(), re.MULTILINE)
    spelled = " ".join(row[0] for row in page.tables("CMake option"))
    for name in declared:
        # One row has several, the common beginning only once.
        if name not in spelled and f"_{name.split('_')[-1]}" not in spelled:
            yield f"{page.name}: says nothing of the CMake option {name}"


def faults(build, root, write):
    all_pages = pages(root)
    page = {page.name: page for page in all_pages}
    settings = read_settings(root)
    options = {}
    for program, (folder, page_name) in PROGRAMS.items():
        executable = build / folder / program
        if not executable.exists():
            print(f"{program} is not built; its options are not checked")
            continue
        options[program] = read_options(executable)
        of_tool = options["pcl_pds_recon"]
        shared = set()
        if program != "pcl_pds_recon":
            shared = {name for name, option in options[program].items() if option.is_same_as(of_tool.get(name))}
        yield from option_checks.check_table(page[page_name], options[program], shared)
        yield from option_checks.check_ranges(executable, options[program])
    yield from option_checks.check_headings(page["docs/parameters.md"], of_tool)
    if "pcl_pds_compare" in options:
        report, comparison = report_checks.write_reports(build, root / "data/duck_scan.ply")
        yield from report_checks.check_keys(page["docs/parameters.md"], report)
        yield from report_checks.check_keys(page["docs/compare.md"], comparison)
    yield from option_checks.check_settings(settings, of_tool)
    yield from option_checks.check_setter_table(page["docs/pcl_class.md"], root, settings)
    yield from check_build_options(page["README.md"], root)

    makers = {
        "file": lambda *arguments: quote_file(root, *arguments),
        "options": lambda: option_checks.option_table(settings, of_tool),
    }
    for each in all_pages:
        yield from option_checks.check_command_lines(each, options)
        yield from check_blocks(each, makers, write)
        yield from check_links(each, all_pages, root)
    yield from check_pictures(all_pages, root)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("build", type=Path)
    parser.add_argument("project", type=Path, nargs="?", default=Path(__file__).resolve().parents[2])
    arguments = parser.parse_args()
    found = list(faults(arguments.build.resolve(), arguments.project.resolve(), arguments.write))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
