#!/usr/bin/env python3
"""Capytaine 3.0.0 over the meshes of crates/diffraction/benches/diffraction.rs, on one core.

    python3 benches/diffraction.py [--large]

Makes target/capytaine-venv with Capytaine from PyPI the first time; without a network, put a wheel in it by hand and it is taken as it is.
Prints panels, frequencies, method, seconds, seconds per frequency, and the peak of the memory so far (MB): six motions and one heading of a
hemisphere in deep water, K a from 0.1 to 2. The table of its Green function is made before. --large adds 6,400 panels, which take minutes.
"""
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
VENV = ROOT / "target" / "capytaine-venv"
WHEEL = "capytaine==3.0.0"
THREADS = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}


def in_environment():
    """Starts this script again with the Python of the environment on one thread; the environment is made when it is not there."""
    if Path(sys.prefix) == VENV and all(os.environ.get(name) == value for name, value in THREADS.items()):
        return
    python = VENV / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", str(VENV)], check=True)
    if subprocess.run([str(python), "-c", "import capytaine"], capture_output=True).returncode != 0:
        subprocess.run([str(python), "-m", "pip", "install", "--quiet", WHEEL], check=True)
    os.execve(str(python), [str(python), *sys.argv], {**os.environ, **THREADS})


def hemisphere(m):
    """4 m2 panels of a hemisphere of radius 1."""
    import capytaine as cpt
    import numpy as np

    t, p = np.pi / 2 * np.arange(m + 1) / m, 2 * np.pi * np.arange(4 * m) / (4 * m)
    t, p = np.meshgrid(t, p, indexing="ij")
    vertices = np.stack([np.cos(t) * np.cos(p), np.cos(t) * np.sin(p), -np.sin(t)], axis=-1).reshape(-1, 3)
    i, j = np.meshgrid(np.arange(m), np.arange(4 * m), indexing="ij")
    at = lambda i, j: i * 4 * m + j % (4 * m)
    faces = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], axis=-1).reshape(-1, 4)
    return cpt.Mesh(vertices=vertices, faces=faces)


def main():
    in_environment()
    import resource

    import capytaine as cpt
    import numpy as np

    cpt.set_logging("ERROR")
    runs = [(10, 20), (20, 20)] + ([(40, 3)] if "--large" in sys.argv else [])
    solver = cpt.BEMSolver(method="direct")
    for m, frequencies in [(4, 1), *runs]:
        body = cpt.FloatingBody(mesh=hemisphere(m), dofs=cpt.rigid_body_dofs(rotation_center=(0, 0, 0)))
        start = time.perf_counter()
        for k in np.linspace(0.1, 2.0, frequencies):
            common = {"body": body, "wavenumber": k, "water_depth": np.inf, "rho": 1000.0, "g": 9.81}
            problems = [cpt.RadiationProblem(radiating_dof=dof, **common) for dof in body.dofs]
            problems.append(cpt.DiffractionProblem(wave_direction=0.0, **common))
            results = solver.solve_all(problems, progress_bar=False)
            if any("Failed" in type(result).__name__ for result in results):
                sys.exit(f"Capytaine failed at {4 * m * m} panels, K = {k}")
        seconds = time.perf_counter() - start
        if (m, frequencies) in runs:
            memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
            print(f"{4 * m * m}\t{frequencies}\tdirect\t{seconds:.3f}\t{seconds / frequencies:.4f}\t{memory:.0f}", flush=True)


main()
