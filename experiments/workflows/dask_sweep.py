"""A parameter study by Dask, each case in a process of its own.

    ./tack python experiments/workflows/dask_sweep.py        # on the cores of this machine
    ./tack python experiments/workflows/dask_sweep.py ADDRESS  # on the workers of a scheduler

A scheduler with workers on a cluster is started by `dask-jobqueue` (SLURMCluster) or by
`dask-scheduler` and `dask-worker`. All workers have to see this folder and the package `tack`.
"""
import os
import sys

SCENE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "first", "hang.yaml")


def final_gap(young):
    """Runs the scene with one modulus [MPa]; returns the gap to the ceiling at its end [m]."""
    import tack  # in the worker

    sim = tack.Simulation(SCENE, set={"objects.cube.energies.0.young": f"{young} MPa"}, threads=1)
    sim.run()
    return sim.probes()["gap"]


def main():
    from dask.distributed import Client, LocalCluster

    young = [0.1, 0.2, 0.4]
    # Processes, not threads: each has a simulation and memory of its own.
    cluster = sys.argv[1] if len(sys.argv) > 1 else LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None)
    with Client(cluster) as client:
        print("young [MPa], final gap [mm]")
        for modulus, gap in zip(young, client.gather(client.map(final_gap, young))):
            print(f"{modulus}, {1e3 * gap:.4f}")


if __name__ == "__main__":
    main()
