"""Many runs: rows as runs finish, on one process and on workers that are killed, and what a second call makes."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import falling_ball, same_bits
from simulator_test import exploding_bar

import gelatin
from gelatin import sweep_cluster, sweep_command
from gelatin.sweep_folder import Folder, read_row, write_row
from gelatin.sweep_run import Job, make_run, write_dead_run
from gelatin.sweep_settings import Plan

MODULI = {"material.jelly.youngs_modulus": [1e4, 1e5, 1e6]}
OF_THE_CLOCK = ("frame_ms", "seconds", "worker")


@pytest.fixture(scope="module")
def cluster():
    """Two workers. A run whose process dies is made twice more."""
    import dask
    from distributed import LocalCluster

    with dask.config.set({"distributed.scheduler.allowed-failures": 1}):
        with sweep_cluster._without_main(), LocalCluster(
            n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
        ) as cluster:
            yield cluster


@pytest.fixture
def ball():
    scene = falling_ball(0.55)
    scene.simulation.frames = 6
    return scene


def values(table):
    return table.drop_columns([name for name in OF_THE_CLOCK if name in table.column_names]).to_pylist()


def here(subject, vary=None, **options):
    """In this process."""
    return gelatin.sweep(subject, vary, workers=0, progress=False, **options)


def log_run(run):
    """What is written when a run begins."""
    with open(run.folder.parent / "began.log", "a") as log:
        log.write(run.name + "\n")


def runs_begun(folder):
    return (folder / "began.log").read_text().split()


# One process


def test_a_row_has_settings_statistics_and_a_recording(ball, tmp_path):
    table = here(ball, MODULI, out=tmp_path / "out")
    rows = table.to_pylist()
    assert [row["material.jelly.youngs_modulus"] for row in rows] == [1e4, 1e5, 1e6]
    sim = gelatin.Simulator(falling_ball(0.55, youngs_modulus=1e5), backend="cpu")
    peak = 0.0
    for _ in range(6):
        sim.advance(1)
        peak = max(peak, float(np.linalg.norm(sim.velocities, axis=1).max()))
    measured = sim.statistics()
    row = rows[1]
    for name in ("kinetic_energy", "elastic_energy", "potential_energy", "contacts"):
        assert row[name] == measured[name]
    assert row["volume_ratio"] == measured["volume_ratio"]["ball"]
    assert row["peak_speed"] == pytest.approx(peak, rel=1e-6)
    (force,) = measured["contact_forces"]
    assert row["contact_force"] == pytest.approx(np.linalg.norm(np.add(force["normal"], force["friction"])))
    assert row["peak_contact_force"] >= row["contact_force"] > 0
    assert (row["nodes"], row["frames"], row["seed"], row["error"]) == (len(sim.masses), 6, None, None)
    player = gelatin.play(tmp_path / "out" / row["recording"])
    assert player.frames == list(range(7))
    player.show(6)
    assert same_bits(player.positions, sim.positions)

    import pyarrow.parquet

    assert pyarrow.parquet.read_table(tmp_path / "out/table.parquet").equals(table)


def test_seeds_displace_nodes_where_they_draw_nothing(ball, tmp_path):
    rows = here(ball, out=tmp_path / "a", seeds=[4, 5], record=0).to_pylist()
    again = here(ball, out=tmp_path / "b", seeds=[5], record=0).to_pylist()
    assert rows[0]["kinetic_energy"] != rows[1]["kinetic_energy"] == again[0]["kinetic_energy"]
    assert rows[0]["kinetic_energy"] == pytest.approx(rows[1]["kinetic_energy"], rel=1e-2)
    vary = {"material.jelly.density": gelatin.Between(900.0, 1100.0)}
    drawn = here(ball, vary, out=tmp_path / "c", seeds=1, record=0).to_pylist()[0]
    sim = gelatin.Simulator(falling_ball(0.55, density=drawn["material.jelly.density"]), backend="cpu")
    sim.advance(6)
    assert sim.statistics()["kinetic_energy"] == drawn["kinetic_energy"]  # and nothing is displaced


def test_a_second_call_makes_what_is_missing(ball, tmp_path):
    first = here(ball, {"material.jelly.density": [900, 1000]}, out=tmp_path, record=0)
    second = here(ball, {"material.jelly.density": [1000.0, 1100]}, out=tmp_path, record=0)
    assert second["material.jelly.density"].to_pylist() == [1000, 1100, 900]  # this call's first
    assert second.to_pylist()[0] == first.to_pylist()[1]  # its time and its process, too
    ball.objects[0].position = (0, 0.6, 0)
    with pytest.raises(gelatin.InvalidInput, match="has runs of another sweep: its scene was .*; another one needs another folder"):
        here(ball, {"material.jelly.density": [1000]}, out=tmp_path)


def test_a_run_that_fails_is_a_row_with_its_error(tmp_path):
    def function(run):
        if run["k"] == 1:
            raise RuntimeError("of two\nlines")
        return {"square": run["k"] ** 2, "seed": 3} if run["k"] == 3 else {"square": run["k"] ** 2}

    rows = here(function, {"k": [0, 1, 2, 3]}, out=tmp_path).to_pylist()
    assert [row["square"] for row in rows] == [0, None, 4, None]
    assert rows[1]["error"] == "RuntimeError: of two lines"
    assert "'seed': is the name of another column" in rows[3]["error"]
    assert "in function" in (tmp_path / "errors" / f"{rows[1]['run']}.txt").read_text()
    calls = []
    function = lambda run: calls.append(run["k"])  # noqa: E731
    function.__qualname__ = json.loads((tmp_path / "sweep.json").read_text())["function"]
    here(function, {"k": [0, 1, 2, 3]}, out=tmp_path)
    assert calls == []
    rows = here(function, {"k": [0, 1, 2, 3]}, out=tmp_path, retry_failed=True).to_pylist()
    assert calls == [1, 3]
    assert [row["error"] for row in rows] == [None] * 4


def test_what_is_known_of_a_run_that_fails(tmp_path):
    def fail(sim):
        raise RuntimeError("at the end")

    (row,) = here(falling_ball(0.6), frames=5, out=tmp_path / "a", measure=fail).to_pylist()
    assert (row["error"], row["frames"], row["kinetic_energy"] > 0) == ("RuntimeError: at the end", 5, True)
    (row,) = here(exploding_bar(), frames=10000, out=tmp_path / "b").to_pylist()
    assert row["error"].startswith("Diverged: ")
    assert 0 < row["frames"] < 10000
    assert gelatin.play(tmp_path / "b" / row["recording"]).frames[-1] == row["frames"]


def test_a_function_has_random_numbers_and_files(tmp_path):
    def function(run):
        path = run.file("x.npy")
        np.save(path, run.random.uniform(size=3))
        return {"states": path, "name": run.name, "vector": np.arange(2.0), "kind": "text" if run.seed else 1}

    rows = here(function, out=tmp_path, seeds=2).to_pylist()
    assert rows[0]["states"] == f"files/{rows[0]['run']}.x.npy"
    for row in rows:
        assert (np.load(tmp_path / row["states"]) == np.random.default_rng(row["seed"]).uniform(size=3)).all()
    assert rows[0]["vector"] == [0, 1] and rows[0]["name"] == rows[0]["run"]
    assert [row["kind"] for row in rows] == ["1", '"text"']  # of two types: as JSON


def test_warnings_are_a_column(tmp_path, caplog):
    import logging

    def function(run):
        logging.getLogger("gelatin").warning("thin")
        logging.getLogger("gelatin").info("repaired")

    assert here(function, {"k": [1, 2]}, out=tmp_path)["warnings"].to_pylist() == ["thin", "thin"]
    assert not caplog.records


def test_a_folder_is_used_by_one_call_at_a_time(tmp_path):
    with Folder(tmp_path, {"function": "f"}) as folder:
        (tmp_path / "rows/a.json.0123.partial").write_text('{"run": "a", ')  # of a process that was killed
        assert folder.rows() == {}
        folder.remove_partial_files()
        assert not list((tmp_path / "rows").iterdir())
        with pytest.raises(gelatin.InvalidInput, match="another sweep is using this folder"):
            Folder(tmp_path, {"function": "f"})
    with Folder(tmp_path, {"function": "f"}):
        pass


def test_a_row_is_whole_or_not_there(tmp_path, monkeypatch):
    (tmp_path / "rows").mkdir()
    row = {"run": "a", "attempt": 1}
    write_row(tmp_path, row)
    monkeypatch.setattr(os, "replace", lambda *_: 1 / 0)  # killed before it
    with pytest.raises(ZeroDivisionError):
        write_row(tmp_path, {**row, "attempt": 2})
    assert read_row(tmp_path, "a") == row
    assert read_row(tmp_path, "b") is None
    (tmp_path / "rows/a.json").write_text('{"run"')
    with pytest.raises(gelatin.InvalidInput, match="a.json: is damaged; without it, the run is made again"):
        read_row(tmp_path, "a")


# Workers


def test_two_workers_make_the_table_of_one_process(cluster, ball, tmp_path):
    one = here(ball, MODULI, seeds=2, out=tmp_path / "one")
    two = gelatin.sweep(ball, MODULI, seeds=2, out=tmp_path / "two", cluster=cluster.scheduler_address, progress=False)
    assert values(one) == values(two)
    assert len(set(two["worker"].to_pylist())) == 2
    for row in one.to_pylist():
        frames = (tmp_path / "one" / row["recording"]).read_bytes(), (tmp_path / "two" / row["recording"]).read_bytes()
        assert frames[0] == frames[1]


def test_a_killed_workers_runs_go_elsewhere(cluster, tmp_path):
    def function(run):
        log_run(run)
        if run["k"] == 5 and not (run.folder / "killed").exists():
            (run.folder / "killed").touch()
            os.kill(os.getpid(), signal.SIGKILL)
        time.sleep(0.02)
        return {"square": run["k"] ** 2}

    function.__module__ = log_run.__module__ = "__main__"  # workers do not have this file
    table = gelatin.sweep(function, {"k": range(20)}, out=tmp_path / "out", cluster=cluster, progress=False)
    assert table["square"].to_pylist() == [k * k for k in range(20)]
    assert table["error"].null_count == 20
    begun = runs_begun(tmp_path)
    again = {name for name in begun if begun.count(name) > 1}
    assert again == {table["run"][5].as_py()}


def test_a_run_that_kills_its_worker_is_a_row(cluster, tmp_path):
    def function(run):
        if run["k"] == 1:
            os.kill(os.getpid(), signal.SIGKILL)

    table = gelatin.sweep(function, {"k": [0, 1]}, out=tmp_path, cluster=cluster, progress=False)
    errors = table["error"].to_pylist()
    assert errors[0] is None and errors[1].startswith("WorkerDied: ")
    assert here(function, {"k": [0, 1]}, out=tmp_path)["error"].to_pylist() == errors  # it is not made again


def test_a_row_that_was_read_counts_although_its_worker_died_since(tmp_path, monkeypatch):
    import distributed

    read = tmp_path / "read"

    class ReadLate(distributed.as_completed):
        """Gives the first results only after Dask has lost them."""

        def next_batch(self, block=True):
            batch = super().next_batch(block)
            read.touch()
            while any(future.key.split("-")[2] == first and future.status == "finished" for future, _ in batch):
                time.sleep(0.01)
            return batch

    def function(run):
        while run["k"] == 1 and not read.exists():
            time.sleep(0.01)
        if run["k"] == 1:
            os.kill(os.getpid(), signal.SIGKILL)

    first = Plan({"k": 0}, None).name
    monkeypatch.setattr(distributed, "as_completed", ReadLate)
    errors = gelatin.sweep(function, {"k": [0, 1]}, out=tmp_path / "out", workers=1, progress=False)["error"].to_pylist()
    assert errors[0] is None and errors[1].startswith("WorkerDied: ")


PROGRAM = """
import sys, time
from pathlib import Path
import gelatin

def function(run):
    with open(run.folder.parent / "began.log", "a") as log:
        log.write(run.name + "\\n")
    time.sleep(0.03)
    return {"square": run["k"] ** 2}

gelatin.sweep(function, {"k": range(60)}, out=sys.argv[1], workers=int(sys.argv[2]))  # no guard by __name__ is needed
"""


def test_after_everything_was_killed_nothing_is_run_twice(tmp_path):
    out = tmp_path / "out"
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    command = [sys.executable, program, out]
    with subprocess.Popen([*command, "2"], start_new_session=True, stderr=subprocess.DEVNULL) as process:
        while not (tmp_path / "began.log").exists() or len(runs_begun(tmp_path)) < 12:
            assert process.poll() is None
            time.sleep(0.005)
        os.killpg(process.pid, signal.SIGKILL)
    rows = {file.stem for file in (out / "rows").glob("*.json")}
    assert 8 <= len(rows) < 60
    before = len(runs_begun(tmp_path))
    result = subprocess.run([*command, "0"], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert f"{len(rows)} of 60 runs are done already" in result.stderr
    begun = runs_begun(tmp_path)
    assert rows.isdisjoint(begun[before:])
    assert len(begun) - before == 60 - len(rows)
    import pyarrow.parquet

    table = pyarrow.parquet.read_table(out / "table.parquet")
    assert table["square"].to_pylist() == [k * k for k in range(60)]


def test_a_worker_makes_no_finished_run_again(tmp_path):
    """Dask asks for it when it has lost a result with its worker."""
    calls = []
    job = Job(lambda run: calls.append(run.name), tmp_path, "", None, 0, [], None, "cpu", 0.0, None)
    with Folder(tmp_path, {}):
        plan = Plan({"k": 1}, None)
        first = make_run(job, plan, 1)
        assert make_run(job, plan, 1) == write_dead_run(job, plan, 1) == first
        assert len(calls) == 1
        assert make_run(job, plan, 2)["attempt"] == 2 and len(calls) == 2


def test_a_run_has_its_threads():
    """Which the library counts once in a process."""
    program = """
import os, sys
from conftest import falling_ball
import gelatin
from gelatin.sweep_run import limit_threads
limit_threads(int(sys.argv[1]) or None)
gelatin.Simulator(falling_ball(), "cpu").step(5)
print(len(os.listdir("/proc/self/task")), len(os.sched_getaffinity(0)))
"""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(["tests/python", os.environ.get("PYTHONPATH", "")]), "OPENBLAS_NUM_THREADS": "1"}
    counts = []
    for limit in ("0", "1"):
        command = [sys.executable, "-c", program, limit]
        result = subprocess.run(command, capture_output=True, text=True, env=environment)
        assert result.returncode == 0, result.stderr
        counts.append([int(count) for count in result.stdout.split()])
    processors = len(os.sched_getaffinity(0))
    assert counts[0][1] == counts[1][1] == processors  # afterwards it may use all again
    if processors > 1:
        assert counts[1][0] < counts[0][0], counts


def test_a_folder_that_workers_lack_is_one_line(tmp_path):
    class Client:
        def wait_for_workers(self, count):
            pass

        def run(self, function, *arguments):
            return {"tcp://a": function(*arguments), "tcp://b": function(tmp_path / "other", "")}

    with pytest.raises(gelatin.InvalidInput, match="the worker tcp://b has no such folder; all machines must share it"):
        sweep_cluster._check_folder(Client(), tmp_path)


# Before anything is run


@pytest.mark.parametrize(
    "options, message",
    [
        ({"vary": {"material.jely.density": [1]}}, 'there is no material "jely"; there are jelly'),
        ({"vary": {"material.jelly.density": [1000, -1]}}, "density = -1.*greater than 0"),
        ({"what": ["energy"]}, "what: 'energy': there is no such statistic; there are nodes"),
        ({"frames": -1}, "frames: -1: must be 0 or more"),
        ({"threads": 0}, "threads: 0: must be 1 or more"),
        ({"threads": "all"}, "threads = 'all': must be a number, 0 or more"),
        ({"samples": "ab"}, "samples = 'ab': must be a list of dicts"),
        ({"what": "energy"}, "what: 'energy': there is no such statistic; there are nodes"),
    ],
)
def test_bad_input_is_one_line_and_nothing_is_started(ball, tmp_path, options, message):
    with pytest.raises((gelatin.InvalidInput, TypeError), match=message) as caught:
        gelatin.sweep(ball, out=tmp_path / "out", **options)
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_importing_gelatin_imports_nothing_of_sweeps():
    program = "import gelatin, sys; print([m for m in ('dask', 'distributed', 'pyarrow', 'cloudpickle') if m in sys.modules])"
    assert subprocess.run([sys.executable, "-c", program], capture_output=True, text=True).stdout == "[]\n"


def test_a_package_that_is_missing_is_named(ball, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(gelatin.SystemError, match=r"sweeps need the package pyarrow: pip install '.\[sweep\]'"):
        here(ball, out=tmp_path)


# The command


def test_the_command(tmp_path, capsys):
    arguments = ["scenes/bounce.toml", "--out", str(tmp_path / "out"), "--frames", "2", "--every", "2", "--workers", "0"]
    vary = ["--vary", "material.rubber.youngs_modulus=1e5,1e6", "--set", "object.box.position=[-0.9, 2, 0]"]
    assert sweep_command.main([*arguments, *vary, "--seeds", "2"]) == 0
    out, err = capsys.readouterr()
    assert out == f"table: {tmp_path}/out/table.parquet, 4 rows\n"
    assert "4 of 4 runs" in err
    assert len(list((tmp_path / "out/recordings").glob("*.gel"))) == 4
    for wrong, code, message in (
        (["--vary", "material.rubbr.density=1"], 2, 'gelatin: error: vary: material.rubbr.density: there is no material "rubbr"'),
        (["--vary", "density"], 2, "gelatin: error: density: must be KEY=VALUES"),
        (["--vary", "a=1..2:lg"], 2, 'gelatin: error: 1..2:lg: after the colon there may only be "log"'),
        (["--seeds", "many"], 2, "gelatin: error: argument --seeds: invalid int value: 'many' (see gelatin sweep --help)"),
        (["--seeds", "3", "--workers", "1", "--cluster", "nowhere"], 1, "gelatin: error: nowhere: no scheduler of Dask answers there"),
    ):
        assert sweep_command.main([*arguments, *wrong]) == code
        err = capsys.readouterr().err
        assert err.startswith(message) and err.count("\n") == 1, err


def test_the_command_tells_of_runs_that_failed(tmp_path, capsys):
    too_long = ["--set", "simulation.solver=rk4", "--set", "simulation.substeps=1"]  # which only the simulator finds
    arguments = ["scenes/bounce.toml", "--out", str(tmp_path), "--frames", "1", "--workers", "0", "--no-record"]
    assert sweep_command.main([*arguments, *too_long]) == 1
    assert "1 of 1 run failed: the column error says why" in capsys.readouterr().err
