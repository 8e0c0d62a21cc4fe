"""Results of `tack run`, `tack batch`, `tack compare`, `tack calibrate` and `tack suite`, as arrays."""
from __future__ import annotations

import csv
import functools
import html
import json
import math
import os
import pathlib
import tempfile
import xml.etree.ElementTree as ElementTree
from typing import Any, Sequence

import numpy as np

from . import _tack
from . import labelled
from .frames import Frame
from .scene import overrides_of


def shown(folder, title, status=""):
    """Returns the report of a folder as HTML for a notebook; status: of a run without a summary."""
    with tempfile.TemporaryDirectory() as scratch:
        page = pathlib.Path(_tack.report([str(folder)], str(pathlib.Path(scratch) / "report.html"), 0, status)).read_text(encoding="utf-8")
    return f'<iframe title="{html.escape(title)}" srcdoc="{html.escape(page)}" style="width: 100%; height: 720px; border: 0" sandbox="allow-scripts"></iframe>'


class Table(dict):
    """Columns of a CSV file by name: arrays of numbers, or of texts if a cell is no number."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(line for line in file if not line.startswith("#")))
        names = rows[0] if rows else []
        for i, name in enumerate(names):
            self[name] = _column([row[i] if i < len(row) else "" for row in rows[1:]])
        self.rows = max(len(rows) - 1, 0)

    def __missing__(self, name):
        raise KeyError(f"no column '{name}'; there are {', '.join(self)}")


def _column(cells):
    try:
        return np.array([float(cell) if cell != "" else math.nan for cell in cells])
    except ValueError:
        return np.array(cells)


class _Folder:
    def __init__(self, path):
        self.path = pathlib.Path(path)

    def report(self, output: str | os.PathLike = "", frames: int = 0) -> pathlib.Path:
        """Writes the report, one HTML file.

        Parameters
        ----------
        output : str or os.PathLike, optional
            The path of the file; default: report.html in the folder.
        frames : int, optional
            Limit of frames of the 3D view; 0: 200, or fewer if the page would get too large.

        Returns
        -------
        pathlib.Path
            The path of the file.
        """
        return pathlib.Path(_tack.report([str(self.path)], str(output), frames, ""))

    def _repr_html_(self):
        return shown(self.path, self.path.name)


class Run(_Folder):
    """Results of one run: `summary`, `probes` and `steps` (columns by name), `frames`."""

    @functools.cached_property
    def summary(self) -> dict:
        """summary.json, as a dictionary."""
        return json.loads((self.path / "summary.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def probes(self) -> Table:
        """probes.csv: arrays by name, `time` among them."""
        return Table(self.path / "probes.csv")

    @functools.cached_property
    def steps(self) -> Table:
        """steps.csv: arrays by name, one row per step."""
        return Table(self.path / "steps.csv")

    @property
    def scene(self) -> pathlib.Path:
        """The path of the scene with all defaults resolved."""
        return self.path / "scene.yaml"

    @functools.cached_property
    def frames(self) -> Frames:
        """Frames, read on access: run.frames[-1].x"""
        return Frames(self.path)

    def export(self, to: str, output: str | os.PathLike = "", **settings: object) -> pathlib.Path | None:
        """Writes the shapes of the run for other programs, as `tack export` does.

        Parameters
        ----------
        to : str
            The format: 'pc2', 'usd', ... (`tack list format`).
        output : str or os.PathLike, optional
            The file or folder to write; default: below export in the results folder.
        **settings : object
            Keys of the format, such as fps=25, objects=["cube"].

        Returns
        -------
        pathlib.Path or None
            The path of the file or folder; None for 'vtu', which the run has written.

        Raises
        ------
        InputError
            The format, its keys or the frames cannot be used.
        """
        return export(self.path, to, output, **settings)

    def to_pandas(self, table: str = "probes") -> Any:
        """Returns a table of the run as a DataFrame of pandas, by time; `attrs["units"]` has the units of its columns.

        Parameters
        ----------
        table : {'probes', 'steps', 'gradients', 'stages'}, optional
            The table, a CSV file of the run.

        Returns
        -------
        pandas.DataFrame
            The table.

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        columns = Table(self.path / f"{table}.csv") if table not in ("probes", "steps") else getattr(self, table)
        return labelled.pandas_run(self.path, table, columns)

    def to_xarray(self, fields: Sequence[str] | None = None, every: int = 1) -> Any:
        """Returns the frames as a Dataset of xarray: position and fields over time, vertex or element, and axis, with units and long_name.

        Parameters
        ----------
        fields : sequence of str, optional
            Names of fields; None: all that the frames have.
        every : int, optional
            Takes every so many frames.

        Returns
        -------
        xarray.Dataset
            All of it in memory: 24 bytes per frame and vertex for a vector.

        Raises
        ------
        ImportError
            xarray is not installed.
        ValueError
            There are no frames, no such field, or the number of vertices changes.
        """
        return labelled.xarray_frames(self.path, self.frames, fields, every)

    def __repr__(self):
        return f"<run '{self.summary['name']}': {self.summary['status']}, {self.summary['steps']} steps>"


class Frames:
    """A run's frames in their order."""

    def __init__(self, path):
        self.times, self._paths = [], []
        index = path / "run.pvd"
        if index.exists():
            for entry in ElementTree.parse(index).getroot().iter("DataSet"):
                self.times.append(float(entry.get("timestep")))
                self._paths.append(path / entry.get("file"))

    def __len__(self):
        return len(self._paths)

    def __getitem__(self, i):
        if isinstance(i, slice):
            return [Frame(path) for path in self._paths[i]]
        return Frame(self._paths[i])

    def at(self, time: float) -> Frame:
        """Returns the frame nearest to a time.

        Parameters
        ----------
        time : float
            The time [s].

        Returns
        -------
        Frame
            The nearest one.
        """
        return self[int(np.argmin(np.abs(np.array(self.times) - time)))]


class Batch(_Folder):
    """Results of a batch: `table` (results.csv, columns by name), and its cases as runs."""

    @functools.cached_property
    def table(self) -> Table:
        """results.csv: columns by name, a row per case."""
        return Table(self.path / "results.csv")

    @functools.cached_property
    def cases(self) -> dict:
        """{name: Run} of the cases with a summary, in the order of the table. A case that has changed since it ran is left out until it runs again."""
        listed = json.loads((self.path / "batch.json").read_text(encoding="utf-8"))["cases"]
        return {one["name"]: Run(self.path / one["folder"]) for one in listed if self._has_results(one)}

    def _has_results(self, one):
        try:
            digest = json.loads((self.path / "state" / f"{one['name']}.json").read_text(encoding="utf-8"))["digest"]
        except (OSError, ValueError, KeyError):
            return False
        return digest == one["digest"] and (self.path / one["folder"] / "summary.json").exists()

    def to_pandas(self) -> Any:
        """Returns the table as a DataFrame of pandas, by case; `attrs["units"]` has the units of its columns.

        Returns
        -------
        pandas.DataFrame
            The table.

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        return labelled.pandas_table(self.table, labelled.units_of_batch(self.path, self.table), "case")

    def to_xarray(self) -> Any:
        """Returns the table as a Dataset of xarray with units: over the varied keys if the cases fill a grid, else over the cases, with the varied keys as coordinates.

        Returns
        -------
        xarray.Dataset
            A variable for each column.

        Raises
        ------
        ImportError
            xarray is not installed.
        """
        return labelled.xarray_batch(self.path, self.table)

    def __repr__(self):
        return f"<batch of {self.table.rows} cases: {self.path}>"


class Tables(_Folder):
    """Results of a comparison, a calibration or a suite: its tables by name, columns by name."""

    @functools.cached_property
    def tables(self) -> dict:
        """{name: columns by name} of every CSV file."""
        return {path.stem: Table(path) for path in sorted(self.path.glob("*.csv"))}

    @functools.cached_property
    def summary(self) -> dict:
        """compare.json, calibration.json or leaderboard.json, as a dictionary."""
        name = {"comparison": "compare", "suite": "leaderboard"}.get(_tack.kind_of(str(self.path)), "calibration")
        return json.loads((self.path / f"{name}.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def fits(self) -> dict:
        """{name: columns by name} of a calibration: measured and simulated curves of every experiment; NAME_run has all samples of its best run."""
        return {path.stem: Table(path) for path in sorted((self.path / "fits").glob("*.csv"))}

    def to_pandas(self, table: str) -> Any:
        """Returns a table as a DataFrame of pandas.

        Parameters
        ----------
        table : str
            Its name in `tables`, or in `fits` of a calibration.

        Returns
        -------
        pandas.DataFrame
            The table.

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        return labelled.package("pandas").DataFrame(dict(self.tables[table] if table in self.tables else self.fits[table]))

    def __repr__(self):
        return f"<{_tack.kind_of(str(self.path))}: {', '.join(self.tables)}>"


def export(results: str | os.PathLike, to: str, output: str | os.PathLike = "", **settings: object) -> pathlib.Path | None:
    """Writes the shapes of a run for other programs, as Run.export does.

    Parameters
    ----------
    results : str or os.PathLike
        The folder of the results, which may be that of a run under way.
    to : str
        The format: 'pc2', 'usd', ... (`tack list format`).
    output : str or os.PathLike, optional
        The file or folder to write; default: below export in the results folder.
    **settings : object
        Keys of the format, such as fps=25, objects=["cube"].

    Returns
    -------
    pathlib.Path or None
        The path of the file or folder; None for 'vtu', which the run has written.
    """
    paths = _tack.export(os.fspath(results), to, os.fspath(output), overrides_of(settings))
    return pathlib.Path(paths[0]) if paths else None


def read(folder: str | os.PathLike) -> Run | Batch | Tables:
    """Reads the results in a folder.

    Parameters
    ----------
    folder : str or os.PathLike
        The folder of a run, a batch, a comparison, a calibration or a suite.

    Returns
    -------
    Run or Batch or Tables
        A Run, a Batch, or Tables of a comparison, a calibration or a suite.

    Raises
    ------
    InputError
        The folder has no results.
    """
    kind = _tack.kind_of(str(folder))
    if kind == "run":
        return Run(folder)
    return Batch(folder) if kind == "batch" else Tables(folder)
