"""Shows that ParaView reads a recorded run: every state, at its true time, with points, bonds and breaks.

    pvpython tests/record/paraview_check.py DIR       (DIR: the folder of a run, e.g. out/bending_fine)

Run by hand after a change of the file layout: ParaView (Debian: python3-paraview) is no part of ./test.
What ParaView says is compared with the run's own tables, which are plain text. Exit status 0: all agrees.
"""

import csv
import json
import os
import sys

from paraview import servermanager
from paraview.simple import OpenDataFile

POINT_ARRAYS = {"displacement": 3, "velocity": 3, "bond_strain": 1, "damage": 1, "energy": 1, "stress": 6,
                "body": 1, "spacing": 1}


def values(array):
    return [array.GetComponent(i, c) for i in range(array.GetNumberOfTuples())
            for c in range(array.GetNumberOfComponents())]


def main(folder):
    with open(os.path.join(folder, "states.hdf.series"), encoding="utf-8") as file:
        times = [entry["time"] for entry in json.load(file)["files"]]
    with open(os.path.join(folder, "breaks.csv"), encoding="utf-8") as file:
        breaks = list(csv.DictReader(line for line in file if not line.startswith("#")))

    reader = OpenDataFile(os.path.join(folder, "states.hdf.series"))
    assert list(reader.TimestepValues) == times, (list(reader.TimestepValues)[:5], times[:5])
    reference = None
    for time in times:
        reader.UpdatePipeline(time)
        grid = servermanager.Fetch(reader)
        points, cells = grid.GetPointData(), grid.GetCellData()
        found = {points.GetArrayName(i): points.GetArray(i).GetNumberOfComponents()
                 for i in range(points.GetNumberOfArrays())}
        missing = POINT_ARRAYS.items() - found.items()
        assert not missing, (time, missing)

        broken = values(cells.GetArray("broken"))
        assert len(broken) == grid.GetNumberOfCells() > 0, (time, len(broken), grid.GetNumberOfCells())
        expected = {int(row["bond"]): (int(row["first"]), int(row["second"]))
                    for row in breaks if float(row["time"]) <= time}
        assert {i for i, is_broken in enumerate(broken) if is_broken} == expected.keys(), time
        for bond, ends in expected.items():
            line = grid.GetCell(bond)
            assert line.GetClassName() == "vtkLine" and (line.GetPointId(0), line.GetPointId(1)) == ends, bond

        # Position less displacement is the reference position, the same in every state; positions have single
        # precision.
        shift = values(points.GetArray("displacement"))
        position = values(grid.GetPoints().GetData())
        start = [x - u for x, u in zip(position, shift)]
        reference = reference or start
        scale = max(map(abs, position)) + max(map(abs, shift))
        assert max(abs(a - b) for a, b in zip(start, reference)) <= 2e-7 * scale, time
    print(f"{folder}: ParaView reads {len(times)} states, {times[0]} s to {times[-1]} s, "
          f"{grid.GetNumberOfPoints()} points, {grid.GetNumberOfCells()} bonds, {len(breaks)} broken")


if len(sys.argv) != 2:
    sys.exit(__doc__)
main(sys.argv[1])
