"""A simulation that is stepped from Python, and runs whose results are kept."""
import pathlib
import tempfile
import warnings

from . import _tack
from .results import read, shown
from .scene import opened, overrides_of


class Warned(UserWarning):
    """What a simulation goes on with, but what may make its results worth less than they seem."""


class Object:
    """An object of the scene, in the simulation that it belongs to."""

    def __init__(self, running, known):
        self._running, self._known = running, known
        self.name = known.name
        self.vertices = slice(known.first_vertex, known.first_vertex + known.vertex_count)

    @property
    def x(self):
        """Its positions (n, 3) [m], a view."""
        return self._running.x[self.vertices]

    @property
    def v(self):
        """Its velocities (n, 3) [m/s], a view."""
        return self._running.v[self.vertices]

    tets = property(lambda self: self._known.tets, doc="(n, 4), vertices of the scene counted from 0")
    triangles = property(lambda self: self._known.triangles, doc="(n, 3): of its surface, outwards, and of sheets")
    edges = property(lambda self: self._known.edges, doc="(n, 2): of rods")
    points = property(lambda self: self._known.points, doc="particles")

    def __repr__(self):
        return f"<object '{self.name}': {self.vertices.stop - self.vertices.start} vertices>"


class Simulation:
    """A scene, ready to be stepped. Nothing is written.

    scene: the path of a file, or a dictionary with the same keys.
    set: what is changed of it, {"objects.plate.place.translate": [0, 0.1, 0], "time.step": "2 ms"}.
    threads: of its own; 0: all cores.

    Raises InputError, with file, line and remedy, for a scene that cannot be simulated.
    """

    def __init__(self, scene, set=None, threads=0):
        path, text = opened(scene)
        if text:
            self._running = _tack.Running.parse(text, path, overrides_of(set), threads)
        else:
            self._running = _tack.Running.open(path, overrides_of(set), threads)
        self.objects = {known.name: Object(self._running, known) for known in self._running.objects}
        self._warn()

    name = property(lambda self: self._running.name)
    time = property(lambda self: self._running.time, doc="[s]")
    steps = property(lambda self: self._running.step_count, doc="steps so far")
    duration = property(lambda self: self._running.duration, doc="when the scene ends [s]")
    step_size = property(lambda self: self._running.step_size, doc="what is tried next [s]")
    finished = property(lambda self: self._running.finished)
    threads = property(lambda self: self._running.threads)

    @property
    def x(self):
        """Positions of all vertices (n, 3) [m]: memory of the simulation, which shows its newest step; copy what is to stay. Assign to it to move vertices."""
        return self._running.x

    @x.setter
    def x(self, positions):
        self.move(x=positions)

    @property
    def v(self):
        """Velocities of all vertices (n, 3) [m/s], likewise."""
        return self._running.v

    @v.setter
    def v(self, velocities):
        self.move(v=velocities)

    rest = property(lambda self: self._running.rest, doc="positions without stress (n, 3) [m]")
    mass = property(lambda self: self._running.mass, doc="of vertices, and of unknowns that are none [kg]")

    def __getitem__(self, name):
        """An object by its name."""
        return self.objects[name]

    def move(self, x=None, v=None):
        """Goes on from other positions and velocities (n, 3), as a run that starts there; from those that it has, nothing changes.

        Raises InputError, and leaves everything as it was, for positions that intersect or invert elements, or bend an affine body.
        """
        self._running.move(x, v)

    def step(self, minimizer=None):
        """One time step; returns what is known of it, as a dictionary.

        minimizer: a function that is called with a Problem, and returns the unknowns where it ended; it takes the place of the scene's from now on.
        Raises SimulationError if no step small enough succeeds.
        """
        if minimizer is not None:
            self.minimize_by(minimizer)
        try:
            return self._running.step()
        finally:
            self._warn()

    def minimize_by(self, minimizer):
        """Who solves steps from now on: a function as of step(), or None, the scene's own."""
        self._running.minimize_by(minimizer)

    def run(self, until=None, callback=None):
        """Steps to a time [s], or to the scene's end. callback(simulation) is called after each step; if it returns False, that was the last."""
        end = self.duration if until is None else min(until, self.duration)
        while self.time < end - 1e-9 * self.step_size and not self.finished:
            self.step()
            if callback is not None and callback(self) is False:
                break
        return self

    def problem(self):
        """The incremental potential of the next step, to be looked at; nothing is stepped. Valid until the next call or step."""
        return self._running.problem()

    def energies(self):
        """Energies by name [J]."""
        return self._running.energies()

    def forces(self):
        """Forces on vertices (n, 3) [N], by the term of the potential that exerts them."""
        return self._running.forces()

    def field(self, name):
        """A field of frames, as `output.fields` names it: contact_pressure, gap, von_mises_stress, ... One row per vertex, or per element in the order of frames."""
        return self._running.field(name)

    pressures = property(lambda self: self.field("contact_pressure"), doc="[Pa] of vertices, positive where they press")
    gaps = property(lambda self: self.field("gap"), doc="[m] of vertices to what is nearest; not a number where nothing is within reach")

    def scene(self):
        """The scene with everything that it leaves open, in YAML."""
        return self._running.scene()

    def probes(self):
        """The scene's probes, now."""
        return dict(zip(self._running.probe_columns(), self._running.probe_values()))

    def _repr_html_(self):
        with tempfile.TemporaryDirectory() as folder:
            frame = pathlib.Path(folder) / self.name / "frame_000000.vtu"
            frame.parent.mkdir()
            self._running.write_frame(str(frame))
            (frame.parent / "scene.yaml").write_text(self.scene(), encoding="utf-8")
            (frame.parent / "run.pvd").write_text(
                f'<VTKFile type="Collection"><Collection><DataSet timestep="{self.time!r}" file="{frame.name}"/></Collection></VTKFile>', encoding="ascii")
            return shown(frame.parent, self.name)

    def _warn(self):
        for text in self._running.take_warnings():
            warnings.warn(text, Warned, stacklevel=3)

    def __repr__(self):
        return f"<simulation '{self.name}' at {self.time:g} s of {self.duration:g} s, {len(self.x)} vertices>"


def run(scene, set=None, output="", threads=0, steps=0, resume=False, quiet=True):
    """Runs a scene as `tack run` does, and returns its results: read(folder).

    output: their folder; unless given, results/ and the scene's name. steps: at most so many; 0: to the end. resume: from the folder's newest checkpoint.
    Raises SimulationError if the run fails; what it wrote until then stays.
    """
    path, text = opened(scene)
    return read(_tack.record(path, text, overrides_of(set), str(output), threads, steps, resume, quiet))


