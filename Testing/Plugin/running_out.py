"""Runs a filter while the process cannot grow, and returns the outcome.

    pvpython running_out.py MEGABYTES

runs it as a new process does. No thread has been started yet, no memory is left from before, and
ParaView's proxies, which take a second to load, are not there.
"""
import ctypes
import os
import resource
import sys

import gridfem.vtkGridFEMFilters
from vtkmodules.util.vtkConstants import VTK_STRING
from vtkmodules.vtkFiltersSources import vtkSphereSource

MEGABYTE = 1 << 20
M_MMAP_THRESHOLD = -3  # of malloc.h


def take_arrays_from_the_system():
    """Makes malloc request each array by itself from now on. By default it serves arrays from memory
    that earlier runs have left. A small filter would then meet the limit only by chance."""
    ctypes.CDLL(None).mallopt(M_MMAP_THRESHOLD, 1 << 15)


def data_size():
    """Returns the bytes that the process may write to, which the limit counts."""
    with open("/proc/self/status", encoding="ascii") as status:
        return next(int(line.split()[1]) for line in status if line.startswith("VmData:")) * 1024


class Limit:
    """Limits the growth of the process to so many bytes. The limit is not `ulimit -v`, because
    filters check `ulimit -v` before they compute, and refuse a run that needs more."""

    def __init__(self, room):
        self.room = room

    def __enter__(self):
        resource.setrlimit(resource.RLIMIT_DATA, (data_size() + self.room, resource.RLIM_INFINITY))

    def __exit__(self, *_):
        resource.setrlimit(resource.RLIMIT_DATA, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))


class Outcome:
    """The outcome of one run: its messages, whether all outputs are empty, and the number of finished
    stages."""

    def __init__(self, algorithm, room=None, stages=()):
        self.errors = []

        def listen(_, __, text):
            self.errors.append(text)

        listen.CallDataType = VTK_STRING
        observer = algorithm.AddObserver("ErrorEvent", listen)
        before = [algorithm.GetNumberOfRuns(stage) for stage in stages]
        algorithm.Modified()
        if room is None:
            algorithm.Update()
        else:
            with Limit(room):
                algorithm.Update()
        algorithm.RemoveObserver(observer)
        after = [algorithm.GetNumberOfRuns(stage) for stage in stages]
        self.stages = sum(b - a for a, b in zip(before, after))
        ports = range(algorithm.GetNumberOfOutputPorts())
        self.is_empty = not any(
            algorithm.GetOutputDataObject(port).GetNumberOfElements(kind) > 0
            for port in ports for kind in (0, 1, 6))  # points, cells, rows


def main(room):
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(160)
    sphere.SetPhiResolution(160)
    sphere.Update()
    algorithm = gridfem.vtkGridFEMFilters.vtkScreenedPoisson()
    algorithm.SetInputData(sphere.GetOutput())
    algorithm.SetDepth(6)
    algorithm.SetNumberOfThreads(2)  # on one processor, too
    for outcome in Outcome(algorithm, room), Outcome(algorithm):
        says = outcome.errors[0].rsplit("): ", 1)[-1].strip() if outcome.errors else ""
        os.write(1, f"{len(outcome.errors)} {outcome.is_empty} {says}\n".encode())


if __name__ == "__main__":
    main(int(sys.argv[1]) * MEGABYTE)
