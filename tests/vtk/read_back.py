#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the ParaView files of a run back with VTK and says whether they are what was written.

  read_back.py FOLDER

FOLDER holds tunnel.vtm and the files it names, and for a tunnel of several stages history.pvd with
those of each. What VTK makes of each (cells and points, the kinds of the cells, the names of the
arrays and their ranges) must be what the text of the file says, which is read here without VTK.
Where run.json and bolts.csv lie beside them, numbers must be those of these too, and the last stage
is the end of the tunnel.
"""

import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

import vtk

faults = 0


def check(is_right, what):
    global faults
    if not is_right:
        faults += 1
        print("WRONG: " + what)


class Written:
    """A .vtu by its text alone."""

    def __init__(self, path):
        piece = xml.etree.ElementTree.parse(path).getroot().find("UnstructuredGrid/Piece")
        self.points = int(piece.get("NumberOfPoints"))
        self.cells = int(piece.get("NumberOfCells"))
        self.topology = {a.get("Name"): a.text.split() for a in piece.findall("Cells/DataArray")}
        self.arrays = {}
        for kind in ("CellData", "PointData"):
            for array in piece.findall(kind + "/DataArray"):
                components = int(array.get("NumberOfComponents"))
                numbers = [float(text) for text in array.text.split()]
                self.arrays[kind, array.get("Name")] = [
                    numbers[first::components] for first in range(components)
                ]
        coordinates = [float(text) for text in piece.find("Points/DataArray").text.split()]
        self.bounds = [f(coordinates[axis::3]) for axis in range(3) for f in (min, max)]


def compare(name, grid, path):
    """A grid of VTK with the text it was read from."""
    text = Written(path)
    check(grid.GetNumberOfCells() == text.cells, f"{name}: cells {grid.GetNumberOfCells()}")
    check(grid.GetNumberOfPoints() == text.points, f"{name}: points {grid.GetNumberOfPoints()}")
    check(list(grid.GetBounds()) == text.bounds, f"{name}: bounds {grid.GetBounds()}")
    begin = 0
    for cell in range(text.cells):
        end = int(text.topology["offsets"][cell])
        shape = grid.GetCell(cell)
        of = f"{name}: cell {cell}: "
        check(shape.GetCellType() == int(text.topology["types"][cell]), of + "type")
        ids = sorted(shape.GetPointId(k) for k in range(shape.GetNumberOfPoints()))
        check(ids == sorted(int(k) for k in text.topology["connectivity"][begin:end]), of + "points")
        begin = end
    found = {}
    for kind, data in (("CellData", grid.GetCellData()), ("PointData", grid.GetPointData())):
        for k in range(data.GetNumberOfArrays()):
            array = data.GetArray(k)
            found[kind, array.GetName()] = [
                array.GetRange(component) for component in range(array.GetNumberOfComponents())
            ]
    check(found.keys() == text.arrays.keys(), f"{name}: arrays {sorted(found)}")
    for key, columns in text.arrays.items():
        ranges = [(min(column), max(column)) for column in columns]
        check(found.get(key) == ranges, f"{name}: {key}: {found.get(key)} instead of {ranges}")
    print(
        f"{name}: {text.cells} cells, {text.points} points; "
        + ", ".join(
            f"{key[1]} {ranges[0][0]:.4g} to {ranges[0][1]:.4g}" if len(ranges) == 1 else key[1]
            for key, ranges in found.items()
        )
    )
    return found


def is_near(x, y):
    """Tables and JSON have 8 digits or more."""
    return math.isclose(x, y, rel_tol=1e-7, abs_tol=1e-9)


def compare_with_results(folder, found, cells):
    """The files with what else the program wrote of its run."""
    results = json.loads((folder / "run.json").read_text())
    if "lining" in found and "lining" in results:
        for quantity in ("thrust_kN_per_m", "moment_kNm_per_m"):
            low, high = found["lining"]["PointData", quantity][0]
            largest = high if quantity.startswith("thrust") else max(-low, high)
            expected = results["lining"]["largest_" + quantity]
            check(is_near(largest, expected), f"lining: largest {quantity}: {largest}, {expected}")
    if "bolts" in found:
        count = found["bolts"]["CellData", "bolt"][0][1]
        check(count == results["bolts"]["count"], f"bolts: {count}")
        with open(folder / "bolts.csv", newline="", encoding="utf-8") as table:
            rows = list(csv.DictReader(table))
        force = max(float(row["axial_force_kN"]) for row in rows)
        largest = found["bolts"]["CellData", "axial_force_kN"][0][1]
        check(is_near(largest, force), f"bolts: largest force {largest}, {force}")
        check(cells["bolts"] >= len(rows), "bolts: a length for each joint")
    highest = found["blocks"]["CellData", "block"][0][1]
    check(highest < results["rock"]["bodies"], f"blocks: number {highest}")
    print("run.json and bolts.csv: compared")


def read_together(path, prefix=""):
    """What VTK makes of a .vtm and of the files that it names, each compared with its text."""
    reader = vtk.vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    whole = reader.GetOutput()
    found, cells = {}, {}
    for k in range(whole.GetNumberOfBlocks()):
        name = whole.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME())
        grid = whole.GetBlock(k)
        file = path.parent / (prefix + name + ".vtu")
        if grid is None:
            check(False, f"{path.name}: {name}: VTK reads nothing")
            continue
        found[name] = compare(prefix + name, grid, file)
        cells[name] = grid.GetNumberOfCells()
        # By itself as well: a user may open one file alone.
        alone = vtk.vtkXMLUnstructuredGridReader()
        alone.SetFileName(str(file))
        alone.Update()
        check(alone.GetOutput().GetNumberOfCells() == cells[name], f"{name}: alone")
    files = {file.stem[len(prefix) :] for file in path.parent.glob(prefix + "*.vtu")}
    check(files == set(found), f"{path.name} names {sorted(found)}, there are {sorted(files)}")
    return found, cells


def is_close(x, y):
    """Files of stages have seven digits."""
    return math.isclose(x, y, rel_tol=1e-6, abs_tol=1e-12)


def largest_slip(path):
    """Of the joints of a file that are closed, in mm."""
    arrays = Written(path).arrays
    slips, opened = arrays["CellData", "plastic_slip_mm"][0], arrays["CellData", "open"][0]
    return max((slip for slip, is_open in zip(slips, opened) if not is_open), default=0)


def compare_history(folder, found, cells):
    """The stages: their times, their files, and the last with the end of the tunnel.

    A .pvd is XML that ParaView itself reads, not VTK: it is read here as ParaView does, by the time
    and the file of each entry, in order.
    """
    collection = xml.etree.ElementTree.parse(folder / "history.pvd").getroot()
    check(collection.get("type") == "Collection", "history.pvd: type")
    entries = collection.findall("Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in entries]
    check(times == list(range(1, len(entries) + 1)), f"history.pvd: times {times}")
    check(len(entries) > 1, "history.pvd: more than one stage")
    named, driven = set(), []
    for entry in entries:
        path = folder / entry.get("file")
        stage, cells_then = read_together(path, path.stem + "_")
        named |= {path.name} | {f"{path.stem}_{name}.vtu" for name in stage}
        check("blocks" in stage, f"{path.name}: no blocks")
        driven.append((stage, cells_then))
    there = {path.name for path in (folder / "history").iterdir() if path.suffix != ".svg"}
    check(there == named, f"history: files of no stage {sorted(there - named)}")
    if (folder / "run.json").exists():
        stages = json.loads((folder / "run.json").read_text())["stages"]
        check(len(stages) == len(entries), f"history.pvd: {len(entries)} of {len(stages)} stages")
    last, last_cells = driven[-1]
    for name, arrays in found.items():
        if name == "joints":  # of a stage those alone that have slipped or opened
            slip = largest_slip(folder / "joints.vtu")
            if slip > 0.01:
                then = largest_slip(folder / f"history/{path.stem}_joints.vtu")
                check(is_close(then, slip), f"last stage: slip {then}, {slip}")
                check(last_cells[name] < cells[name], "last stage: joints that have not slipped")
            continue
        check(last_cells.get(name) == cells[name], f"last stage: {name}: {last_cells.get(name)} cells")
        for key, ranges in arrays.items():
            for (low, high), (low_then, high_then) in zip(ranges, last[name][key]):
                check(
                    is_close(low, low_then) and is_close(high, high_then),
                    f"last stage: {name}: {key}: {low_then} to {high_then}, {low} to {high}",
                )
    print(f"history.pvd: {len(entries)} stages")


def main(folder):
    found, cells = read_together(folder / "tunnel.vtm")
    if (folder / "run.json").exists():
        compare_with_results(folder, found, cells)
    if (folder / "history.pvd").exists():
        compare_history(folder, found, cells)
    print(f"VTK {vtk.vtkVersion().GetVTKVersion()}: {faults} wrong")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
