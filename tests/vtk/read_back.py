#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the ParaView files of a run back with VTK and says whether they are what was written.

  read_back.py FOLDER

FOLDER holds tunnel.vtm and the files it names. What VTK makes of each (cells and points, the kinds
of the cells, the names of the arrays and their ranges) must be what the text of the file says,
which is read here without VTK. Where run.json and bolts.csv lie beside them, numbers must be those
of these too.
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


def main(folder):
    reader = vtk.vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(folder / "tunnel.vtm"))
    reader.Update()
    whole = reader.GetOutput()
    found, cells = {}, {}
    for k in range(whole.GetNumberOfBlocks()):
        name = whole.GetMetaData(k).Get(vtk.vtkCompositeDataSet.NAME())
        grid = whole.GetBlock(k)
        path = folder / (name + ".vtu")
        if grid is None:
            check(False, f"{name}: VTK reads nothing")
            continue
        found[name] = compare(name, grid, path)
        cells[name] = grid.GetNumberOfCells()
        # By itself as well: a user may open one file alone.
        alone = vtk.vtkXMLUnstructuredGridReader()
        alone.SetFileName(str(path))
        alone.Update()
        check(alone.GetOutput().GetNumberOfCells() == cells[name], f"{name}: alone")
    files = {path.stem for path in folder.glob("*.vtu")}
    check(files == set(found), f"tunnel.vtm names {sorted(found)}, there are {sorted(files)}")
    if (folder / "run.json").exists():
        compare_with_results(folder, found, cells)
    print(f"VTK {vtk.vtkVersion().GetVTKVersion()}: {faults} wrong")
    return 1 if faults else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(main(pathlib.Path(sys.argv[1])))
