"""What ParaView shows of a file, by each of its readers of XDMF: pvbatch dump_steps.py FILE.xdmf FOLDER.

FOLDER gets READER.npz: "times" [s], and of step i "i/points", "i/cells" (points of each cell), and "i/point/NAME" or
"i/cell/NAME" for each array.
"""

import pathlib
import sys

import numpy
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy

READERS = {
    "XDMFReader": lambda file: simple.XDMFReader(FileNames=[file]),
    "Xdmf3ReaderS": lambda file: simple.Xdmf3ReaderS(FileName=[file]),
    "Xdmf3ReaderT": lambda file: simple.Xdmf3ReaderT(FileName=[file]),
}


def copied(data):
    """VTK's memory is used again for the next step."""
    return vtk_to_numpy(data).copy()


def leaf(data):
    """The one grid of a step, which some readers wrap."""
    while data.IsA("vtkMultiBlockDataSet"):
        blocks = [data.GetBlock(i) for i in range(data.GetNumberOfBlocks())]
        blocks = [block for block in blocks if block is not None]
        if len(blocks) != 1:
            raise SystemExit(f"a step of {len(blocks)} grids")
        data = blocks[0]
    return data


def shown(reader):
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues) if hasattr(reader.TimestepValues, "__len__") else [reader.TimestepValues]
    arrays = {"times": numpy.array(times)}
    for step, time in enumerate(times):
        reader.UpdatePipeline(time)
        grid = leaf(servermanager.Fetch(reader))
        arrays[f"{step}/points"] = copied(grid.GetPoints().GetData())
        cells = grid.GetCells()
        arrays[f"{step}/cells"] = copied(cells.GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
        for place, data in (("point", grid.GetPointData()), ("cell", grid.GetCellData())):
            for i in range(data.GetNumberOfArrays()):
                arrays[f"{step}/{place}/{data.GetArrayName(i)}"] = copied(data.GetArray(i))
    return arrays


def main():
    file, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    for name, opened in READERS.items():
        numpy.savez(folder / f"{name}.npz", **shown(opened(file)))


main()
