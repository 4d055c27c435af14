"""Runs as JUnit XML, by the junitparser library: a suite a run, a test case an expectation, and one a kind of report.

Times are wall seconds, as every reader of JUnit takes them; simulated time and seed are properties of the suite.
"""

from collections.abc import Sequence

from junitparser import Failure, JUnitXml, Skipped, TestCase, TestSuite

from libins.report import report_line
from libins.run import Result

KINDS = {
    "guest_error": "the firmware does nothing wrong",
    "not_modelled": "the firmware uses nothing that is not modelled",
}


def xml(runs: Sequence[tuple[str, Result]], strict: bool) -> str:
    """The document. runs: name and result; strict: a report is a failure."""
    document = JUnitXml("ins run")
    for name, result in runs:
        document.add_testsuite(_suite(name, result, strict))
    document.update_statistics()  # type: ignore[no-untyped-call]
    text: bytes = document.tostring()  # type: ignore[no-untyped-call]
    return f'<?xml version="1.0" encoding="utf-8"?>\n{text.decode("utf-8")}\n'


def _suite(name: str, result: Result, strict: bool) -> TestSuite:
    suite = TestSuite(name)
    for key in ("firmware", "seed", "sim_s", "trace_sha256"):
        suite.add_property(key, str(result.summary[key]))
    cases = [
        _case(name, check.name, check.failure, None if check.judged else "the host is outside the run")
        for check in result.checks
    ]
    for kind, title in KINDS.items():
        reports = [report_line(report) for report in result.summary["reports"] if report["kind"] == kind]
        text = "\n".join(reports)
        case = _case(name, title, text if strict and reports else None)
        if reports:
            case.system_out = text
        cases.append(case)
    cases[0].time = result.summary["wall_s"]
    suite.add_testcases(cases)
    return suite


def _case(suite: str, name: str, failure: str | None, skipped: str | None = None) -> TestCase:
    case = TestCase(name, classname=suite, time=0.0)
    if failure is not None:
        case.result = [Failure(failure)]
    elif skipped is not None:
        case.result = [Skipped(skipped)]
    return case
