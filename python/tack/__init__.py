"""tack: frictional, adhesive contact of elastoplastic solids, sheets, rods and particles.

    import tack

    sim = tack.Simulation("scene.yaml", set={"time.step": "2 ms"})
    sim.run(until=0.5)
    print(sim.x.shape, sim.energies())

    results = tack.run("scene.yaml")     # with all result files of `tack run`
    results.probes["force"]              # arrays
"""
import ctypes as _ctypes
import os as _os

from tack_program import file_of as _file_of

# Makes libtack's symbols global, for plugins that a scene names.
_ctypes.CDLL(str(_file_of("lib", "libtack.so")), mode=_os.RTLD_GLOBAL | _os.RTLD_NOW)

from ._tack import InputError, Problem, SimulationError  # noqa: E402
from ._tack import version as __version__  # noqa: E402
from .calibration import Calibration, Parameter  # noqa: E402
from .law import law  # noqa: E402
from .results import Batch, Run, Tables, export, read  # noqa: E402
from .simulation import Simulation, Warned, run  # noqa: E402
from .solve import solve  # noqa: E402
from .studies import batch, calibrate, compare  # noqa: E402
from .study import Study  # noqa: E402

__all__ = ["Batch", "Calibration", "InputError", "Parameter", "Problem", "Run", "Simulation", "SimulationError", "Study", "Tables", "Warned", "batch", "calibrate", "compare", "export",
           "law", "read", "run", "solve"]
