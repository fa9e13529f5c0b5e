"""Runs Screened Poisson by all ranks together with little memory. The last rank, or each rank with
a larger surface, can grow only by MEGABYTES.

    mpiexec -n 2 pvbatch --symmetric running_out.py MEGABYTES [each]

Prints "computed", or the message. In either case all ranks agree and go on.
"""
import sys

import ranks

MEGABYTE = 1 << 20


def run(depth, mesh, room=None, limited=lambda rank: rank == ranks.RANKS - 1):
    """Returns the messages of a run, and the facts in its output."""
    piece = ranks.piece(mesh, "contiguous")
    filter_ = ranks.make("ScreenedPoisson", depth, Tolerance=1e-8)
    messages = ranks.heard(filter_)
    with ranks.growing_by(room if limited(ranks.RANK) else None):
        output = ranks.run(filter_, piece)[0]
    is_computed = bool(output.GetFieldData().HasArray("Converged"))
    if is_computed != (output.GetNumberOfPoints() > 0):
        messages.append("the output is neither empty nor computed")
    return messages, is_computed


def main():
    if not run(4, ranks.ellipsoid())[1]:
        sys.exit("nothing is computed without a limit")
    room = int(sys.argv[1]) * MEGABYTE
    if sys.argv[2:] == ["each"]:
        messages, is_computed = run(7, ranks.ellipsoid(400, 200), room, lambda rank: True)
    else:
        messages, is_computed = run(6, ranks.ellipsoid(150, 75), room)
    computed = ranks.total(int(is_computed))
    told = ranks.gathered([len(messages)])
    if computed not in (0, ranks.RANKS) or list(told) != [computed == 0] + (ranks.RANKS - 1) * [0]:
        sys.exit(f"rank {ranks.RANK}: {computed} ranks have computed, with {told} messages: {messages}")
    if not run(4, ranks.ellipsoid())[1]:
        sys.exit("nothing is computed afterwards")
    if ranks.RANK == 0:
        print(messages[0] if messages else "computed", flush=True)


main()
