"""scripts/compare_costs marks the sections that take more than their budgets."""

import importlib.machinery
import importlib.util
import subprocess
import sys
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "scripts" / "compare_costs"


def load():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("compare_costs", str(PROGRAM))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("compare_costs", loader))
    loader.exec_module(module)
    return module


class CompareCosts(unittest.TestCase):
    def setUp(self):
        self.program = load()

    def is_over(self, used, budget, scale):
        [row] = self.program.rows([f"build|{used}|9"], {"build": budget}, scale)
        return "OVER BUDGET" in row

    def test_a_section_over_its_budget_is_marked(self):
        self.assertFalse(self.is_over(100, 100, 1.0))
        self.assertFalse(self.is_over(108, 100, 1.0))  # noise
        self.assertTrue(self.is_over(113, 100, 1.0))

    def test_budgets_are_scaled_by_the_speed_of_the_machine(self):
        self.assertFalse(self.is_over(190, 100, 2.0))
        self.assertTrue(self.is_over(70, 100, 0.5))

    def test_a_section_without_a_budget_is_shown(self):
        [row] = self.program.rows(["text|3|4"], {}, 1.0)
        self.assertIn("text", row)
        self.assertNotIn("OVER BUDGET", row)

    def test_every_build_and_test_section_has_a_budget(self):
        script = (PROGRAM.parent / "test").read_text()
        budgets = self.program.read_budgets()
        for section in ("build release, g++ 12", "tests release", "build asan, clang 14", "tests asan", "clang-tidy"):
            self.assertIn(f"'{section}'", script)
            self.assertIn(section, budgets)

    def test_the_build_finds_the_times_that_it_announces(self):
        budgets = self.program.read_budgets()
        line = next(line for line in (PROGRAM.parent / "build").read_text().splitlines() if line.startswith("minutes="))
        for tests, section in (("", "scripts/build"), ("--tests", "scripts/build --tests")):
            run = subprocess.run(["bash", "-uc", f"tests=({tests}); {line}; echo $minutes"], cwd=PROGRAM.parents[1],
                                 capture_output=True, text=True, check=True)
            self.assertEqual(int(run.stdout), int(budgets[section] / 60 + 0.5))


if __name__ == "__main__":
    unittest.main()
