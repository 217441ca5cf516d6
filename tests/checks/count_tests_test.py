"""scripts/count_tests counts every test, and names every failure once."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(__file__).resolve().parents[2] / "scripts" / "count_tests"
PASSED = '<testcase name="{}" status="run" result="completed" />'
SKIPPED = '<testcase name="{}" status="run" result="skipped"><skipped message="no GL" /></testcase>'
FAILED = '<testcase name="{}" status="run" result="completed"><failure message="1 != 2" /></testcase>'

PYTEST = [
    '<testcase classname="a" name="x" time="0.1" />',
    '<testcase classname="a" name="y" time="0.1"><failure message="1 != 2" /></testcase>',
    '<testcase classname="a" name="z" time="0.1"><error message="no fixture" /></testcase>',
    '<testcase classname="a" name="w" time="0.1"><skipped message="no GL" /></testcase>',
]


def count(suites, reports):
    """The program's lines: `suites` are CTest's verdicts by name, `reports` the test cases of suites."""
    with tempfile.TemporaryDirectory() as root:
        folder = Path(root)
        cases = "".join(f'<testcase name="{name}" status="{status}" />' for name, status in suites.items())
        (folder / "tests.xml").write_text(f"<testsuite>{cases}</testsuite>")
        for name, tests in reports.items():
            report = folder / "reports" / f"{name}.xml"
            report.parent.mkdir(parents=True, exist_ok=True)
            report.write_text(f"<testsuites><testsuite>{''.join(tests)}</testsuite></testsuites>")
        result = subprocess.run([sys.executable, PROGRAM, root], capture_output=True, text=True, check=True)
        return result.stdout.splitlines()


class CountTests(unittest.TestCase):
    def test_every_test_of_a_suite_counts(self):
        reports = {"gpu/A": [PASSED.format("x"), PASSED.format("y")], "gpu/All/B": [PASSED.format("z")]}
        self.assertEqual(count({"gpu.A": "run", "gpu.All/B": "run"}, reports), ["3 0"])

    def test_a_program_without_suites_is_one_test(self):
        self.assertEqual(count({"checks.a": "run", "checks.b": "fail"}, {}), ["FAILED: checks.b", "1 1"])

    def test_failed_tests_are_named_and_the_others_count(self):
        reports = {"cpu/A": [PASSED.format("x"), FAILED.format("y")]}
        self.assertEqual(count({"cpu.A": "fail"}, reports), ["FAILED: cpu.A.y", "1 1"])

    def test_a_suite_that_crashed_is_named(self):
        self.assertEqual(count({"cpu.A": "fail"}, {}), ["FAILED: cpu.A", "0 1"])

    def test_a_suite_that_failed_after_its_tests_is_named(self):
        self.assertEqual(count({"cpu.A": "fail"}, {"cpu/A": [PASSED.format("x")]}), ["FAILED: cpu.A", "1 1"])

    def test_reports_of_pytest_count_too(self):
        lines = ["FAILED: python.pytest.y", "FAILED: python.pytest.z", "1 2"]
        self.assertEqual(count({"python.pytest": "fail"}, {"python/pytest": PYTEST}), lines)

    def test_what_is_skipped_or_was_not_run_does_not_count(self):
        reports = {"gl/A": [SKIPPED.format("x"), PASSED.format("y")]}
        self.assertEqual(count({"gl.A": "run", "gl.B": "disabled"}, reports), ["1 0"])


if __name__ == "__main__":
    unittest.main()
