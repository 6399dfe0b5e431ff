"""MoorDyn 2.7.2's largest lean of the rod of rod_pendulum.txt, its body moved by 2 m in x every 12 s: of the last two periods of 96 s, with 12, 24
and 48 segments. Run in a Python with moordyn and numpy. The step of the coupling is 0.01 s."""
import pathlib
import tempfile

import moordyn
import numpy as np

TEXT = (pathlib.Path(__file__).parent / "rod_pendulum.txt").read_text()
for segments in (12, 24, 48):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "deck.txt"
        path.write_text(TEXT.replace("-12  12  p", f"-12  {segments}  p"))
        system = moordyn.Create(str(path))
        start = np.array([0.0, 0.0, -20.0, 0.0, 0.0, 0.0])
        amplitude, frequency, step = np.array([2.0, 0.0, 0.0, 0.0, 0.0, 0.0]), 2 * np.pi / 12, 0.01
        moordyn.Init(system, list(start), [0.0] * 6)
        rod = moordyn.GetRod(system, 1)
        leans = []
        for index in range(9600):
            time = index * step
            place = start + amplitude * np.sin(frequency * time)
            moordyn.Step(system, list(place), list(amplitude * frequency * np.cos(frequency * time)), time, step)
            head, foot = (np.array(moordyn.GetRodNodePos(rod, node)) for node in (0, segments))
            leans.append(np.degrees(np.arctan2(head[0] - foot[0], head[2] - foot[2])))
        moordyn.Close(system)
    print(f"\n{segments} segments: largest {max(leans[7200:]):.3f} deg, least {min(leans[7200:]):.3f} deg")
