# SPDX-License-Identifier: BSD-3-Clause
"""Compares what the pages say of the programs' JSON reports with what the programs write."""
import json
import re
import subprocess
import tempfile
from pathlib import Path


def write_reports(build, scan):
    """The reports of a reconstruction, and of its mesh's comparison with the scan."""
    with tempfile.TemporaryDirectory() as directory:
        mesh, report = Path(directory) / "mesh.ply", Path(directory) / "report.json"
        subprocess.run([build / "tools/pcl_pds_recon", "-q", "--report", report, scan, mesh], check=True)
        command = [build / "tools/compare/pcl_pds_compare", "--json", "--samples", "1000", mesh, scan]
        comparison = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        return json.loads(report.read_text()), json.loads(comparison)


def all_keys(value):
    """Those of an object and of all objects within."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield key
            yield from all_keys(inner)


def check_keys(page, report):
    """The page's tables of keys name every key of the report, and no other."""
    rows = page.tables("key") + page.tables("key in `certificate`")
    spans = " ".join(span for row in rows for span in re.findall(r"`([^`]*)`", row[0]))
    documented = set(re.findall(r"\w+", spans))
    keys = set(all_keys(report))
    yield from (f"{page.name}: says nothing of the key {key}" for key in sorted(keys - documented))
    yield from (f"{page.name}: the report has no key {key}" for key in sorted(documented - keys))
