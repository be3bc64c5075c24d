# SPDX-License-Identifier: BSD-3-Clause
"""The check of the documentation finds what is wrong: each case spoils the same copy of the project in one place.

  check_fails_test.py PROJECT_DIR BUILD_DIR
"""
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT, BUILD = Path(sys.argv[1]), Path(sys.argv[2])
INCLUDE = "pcl_pds_recon/include/"
SETTERS = INCLUDE + "pcl/surface/poisson_disk_reconstruction.h"

# What is spoiled: file, text, text instead, a part of the line that tells.
CASES = {
    "default in README": ("README.md", "| `-f`, `--radius-factor X` | 3 |", "| `-f`, `--radius-factor X` | 4 |",
                          "README.md: --radius-factor has the default '3', not '4'"),
    "range in README": ("README.md", "4 ... 200", "4 ... 300", "README.md: --k-neighbors has the range"),
    "option missing in README": ("README.md", "| `--hole-size X` |", "| |", "README.md: says nothing of --hole-size"),
    "option that is not there": ("README.md", "`--ascii`", "`--ascii`, `--binary`", "there is no option --binary"),
    "letter of another option": ("README.md", "`-a`, `--adaptive C`", "`-A`, `--adaptive C`",
                                 "README.md: --adaptive is also -a"),
    "build option missing": ("README.md", "`PCL_PDS_RECON_INSTALL`", "", "the CMake option PCL_PDS_RECON_INSTALL"),
    "default of another program": ("docs/compare.md", "| 400000 |", "| 100000 |", "docs/compare.md: --samples has"),
    "key of a report": ("docs/compare.md", "| `diagonal` |", "| `diameter` |",
                        "docs/compare.md: says nothing of the key diagonal"),
    "key that is not there": ("docs/parameters.md", "`thinned_points`", "`thin_points`",
                              "docs/parameters.md: the report has no key thin_points"),
    "option without a heading": ("docs/parameters.md", "### `--seed N`", "### Chance", "--seed has no heading"),
    "default of a setter": ("docs/pcl_class.md", "| `setKSearch` | 15 |", "| `setKSearch` | 16 |",
                            "docs/pcl_class.md: setKSearch has the default 15, not 16"),
    "setter missing": ("docs/pcl_class.md", "| `setSeed` |", "| `setLuck` |", "docs/pcl_class.md: says nothing of setSeed"),
    "setter's comment": (SETTERS, "(4 ... 200, default 15)", "(4 ... 200, default 20)", "setKSearch says default 20"),
    "range in setter's comment": (SETTERS, "(1.5 ... 1000, default 3)", "(1 ... 1000, default 3)",
                                  "setRadiusFactor has the range"),
    "default in the code": (INCLUDE + "pcl_pds_recon/options.h", "hole_size = 15.0", "hole_size = 12.0",
                            "options.h: hole_size is 12, but --hole-size 15"),
    "program that was changed": ("docs/tutorial/statue.cpp", "setRadiusFactor(3)", "setRadiusFactor(4)",
                                 "docs/tutorial.md: a generated block is out of date"),
    "program that is not compiled": ("docs/tutorial.md", "## What next?", "```cpp\nint x;\n```\n## What next?",
                                     "docs/tutorial.md: quotes no compiled file"),
    "command line": ("docs/tutorial.md", "## What next?", "    pcl_pds_recon --noise 3 a.ply b.ply\n\n## What next?",
                     "there is no option --noise"),
    "link": ("docs/tutorial.md", "(parameters.md)", "(options.md)", "links to options.md, which is not there"),
    "link to a heading": ("docs/migration.md", "(#poisson)", "(#kazhdan)", "there is no such heading"),
    "picture that no page shows": ("docs/parameters.md", "![](parameters/seed_1.png)", "", "seed_1.png: no page shows"),
}


class CheckFails(unittest.TestCase):
    def setUp(self):
        self.copy = Path(tempfile.mkdtemp()) / "project"
        shutil.copytree(PROJECT, self.copy, ignore=shutil.ignore_patterns(".git", "build*", "demo"))
        self.addCleanup(shutil.rmtree, self.copy.parent)

    def run_check(self):
        script = PROJECT / "tools/documentation/check_documentation.py"
        return subprocess.run([script, BUILD, self.copy], capture_output=True, text=True, check=False)

    def test_good_project_passes(self):
        result = self.run_check()
        self.assertEqual((result.returncode, result.stdout, result.stderr), (0, "", ""))

    def test_each_fault_is_found(self):
        for name, (file, text, instead, _) in CASES.items():
            with self.subTest(name):
                path = self.copy / file
                self.assertIn(text, path.read_text())
                path.write_text(path.read_text().replace(text, instead, 1))
        result = self.run_check()
        self.assertEqual(result.returncode, 1, result.stderr)
        for name, (_, _, _, expected) in CASES.items():
            with self.subTest(name):
                self.assertIn(expected, result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
