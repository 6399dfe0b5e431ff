"""MoorDyn 2.7.2's force on the fairlead of taut_leg.txt, moved by 2 m in x and 1 m in z every 12 s: largest and least of the last three
periods of 96 s. Run in a Python with moordyn and numpy. The step of the coupling is 0.01 s: MoorDyn goes straight on within it, and with
0.1 s the range is 2 % too wide. The force is that on the point: FairTen is the tension in the middle of the last segment."""
import pathlib

import moordyn
import numpy as np

system = moordyn.Create(str(pathlib.Path(__file__).parent / "taut_leg.txt"))
start = np.array([20.0, 0.0, -15.0])
amplitude, frequency, step = np.array([2.0, 0.0, 1.0]), 2 * np.pi / 12, 0.01
moordyn.Init(system, list(start), [0.0] * 3)
fairlead = moordyn.GetPoint(system, 2)
forces = []
for index in range(9600):
    time = index * step
    place = start + amplitude * np.sin(frequency * time)
    moordyn.Step(system, list(place), list(amplitude * frequency * np.cos(frequency * time)), time, step)
    forces.append(np.linalg.norm(moordyn.GetPointForce(fairlead)))
moordyn.Close(system)
late = forces[6000:]
print(f"\nlargest {max(late):.1f} N, least {min(late):.1f} N")
