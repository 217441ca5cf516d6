"""`gelatin sweep`: gelatin.sweep on the command line."""

from __future__ import annotations

import argparse
import re
import sys
from typing import Any, Callable, NoReturn

from .errors import Diverged, Error, InvalidInput, NoOpenGl
from .sweep_settings import Between
from .sweep_statistics import STATISTICS
from .sweeps import sweep

KINDS: tuple[Callable[[str], Any], ...] = (int, float)  # in which order numbers are tried


class Parser(argparse.ArgumentParser):
    """What is wrong is one line, as of the program's other commands."""

    def error(self, message: str) -> NoReturn:
        raise InvalidInput(f"{message} (see gelatin sweep --help)")


def main(arguments: list[str]) -> int:
    """Runs the command, and returns its exit code; docs/command-line.md."""
    try:
        return run(arguments)
    except InvalidInput as problem:
        return fail(2, problem)
    except Diverged as problem:
        return fail(3, problem)
    except NoOpenGl as problem:
        return fail(4, problem)
    except (Error, OSError) as problem:
        return fail(1, problem)
    except KeyboardInterrupt:
        return fail(1, "interrupted; the same command makes the runs that are missing")


def fail(code: int, problem: object) -> int:
    print(f"gelatin: error: {' '.join(str(problem).split())}", file=sys.stderr)
    return code


def run(arguments: list[str]) -> int:
    options = parser().parse_args(arguments)
    vary = dict(parse_setting(text, values_of) for text in options.vary)
    vary.update(parse_setting(text, lambda value: [value_of(value)]) for text in options.set)
    table = sweep(
        options.scene,
        vary,
        out=options.out,
        seeds=options.seeds,
        frames=options.frames,
        record=0 if options.no_record else options.every,
        what=options.what.split(",") if options.what else None,
        backend=options.backend,
        scatter=options.scatter,
        cluster=options.cluster,
        workers=options.workers,
        threads=options.threads,
        retry_failed=options.retry_failed,
        progress=not options.quiet,
    )
    if not options.quiet:
        print(f"table: {options.out}/table.parquet, {table.num_rows} rows")
    return 1 if table["error"].null_count < table.num_rows else 0


def parser() -> Parser:
    made = Parser(
        prog="gelatin sweep",
        description="Runs a scene with varied settings, on all processors or on a cluster of Dask's; the results are one table. "
        "The same command again makes what is missing.",
        allow_abbrev=False,
    )
    add = made.add_argument
    add("scene", metavar="SCENE", help="a scene file")
    add("--out", required=True, metavar="DIR", help="folder of the table and the recordings")
    add("--vary", action="append", default=[], metavar="KEY=VALUES",
        help="values, as material.jelly.youngs_modulus=1e4,1e5,1e6; or what seeds draw from: 1e4..1e6, with logarithms 1e4..1e6:log")
    add("--set", action="append", default=[], metavar="KEY=VALUE", help="one value for all runs")
    add("--seeds", type=int, metavar="N", help="make N runs of each combination, with seeds from 0")
    add("--scatter", type=float, metavar="X", help="seeds displace nodes by up to X times the body's size; 1e-4 where they draw nothing")
    add("--frames", type=int, metavar="N", help="run to frame N instead of the scene's")
    add("--every", type=int, default=1, metavar="K", help="record every K-th frame (1)")
    add("--no-record", action="store_true", help="no recordings")
    add("--what", metavar="NAME,...", help=f"statistics; all by default: {', '.join(STATISTICS)}")
    add("--backend", default="cpu", choices=("auto", "gl", "cpu"), help="with gl each worker has a GPU of its own (cpu)")
    add("--cluster", metavar="ADDRESS", help="a scheduler of Dask, as tcp://host:8786; without it a cluster is started here")
    add("--workers", type=int, metavar="N", help="of the cluster that is started; 0: none, this process makes the runs")
    add("--threads", type=int, default=1, metavar="N", help="processors for each run (1)")
    add("--retry-failed", action="store_true", help="make runs again that have failed")
    add("--quiet", action="store_true", help="no progress")
    return made


def parse_setting(text: str, read: Callable[[str], Any]) -> tuple[str, Any]:
    key, equals, value = text.partition("=")
    if not equals or not key or not value:
        raise InvalidInput(f"{text}: must be KEY=VALUES, as in material.jelly.youngs_modulus=1e4,1e5,1e6")
    return key, read(value)


def values_of(text: str) -> Any:
    """1e4,1e5 or [0, 1, 0],[0, 2, 0] are lists; 1e4..1e6 and 1e4..1e6:log are draws."""
    low, dots, high = text.partition("..")
    if not dots:
        return [value_of(part) for part in split(text)]
    high, _, log = high.partition(":")
    if log not in ("", "log"):
        raise InvalidInput(f'{text}: after the colon there may only be "log"')
    return Between(value_of(low), value_of(high), log=bool(log))


def split(text: str) -> list[str]:
    """At commas outside of brackets and quotation marks."""
    return re.findall(r"(?:\[(?:[^\[\]]|\[[^\]]*\])*\]|\"[^\"]*\"|[^,\[\"])+", text)


def value_of(text: str) -> Any:
    """A value of TOML: a number, true, false, a list, a text, which may lack its quotation marks."""
    text = text.strip()
    if text in ("true", "false"):
        return text == "true"
    if text.startswith("[") and text.endswith("]"):
        return [value_of(part) for part in split(text[1:-1])]
    for kind in KINDS:
        try:
            return kind(text)
        except ValueError:
            continue
    return text.strip("\"'")
