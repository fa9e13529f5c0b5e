"""Filters by all ranks together, in a build that cannot: rank 0 gathers and says so."""
import unittest

import ranks


class WithoutMpi(unittest.TestCase):
    def test_rank_0_gathers_and_says_so(self):
        for name, array in (("ScreenedPoisson", "Solution"), ("LaplaceSpectrum", "Mode001")):
            filter_ = ranks.make(name, Distributed=True)
            warnings = ranks.heard(filter_, "WarningEvent")
            output = ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
            problems = [] if output.GetPointData().HasArray(array) else [f"no {array}"]
            if len(warnings) != (1 if ranks.RANK == 0 else 0) or not all(
                    "MPI" in text for text in warnings):
                problems.append(f"{name}: the warnings are {warnings}")
            ranks.check(self, problems)


if __name__ == "__main__":
    ranks.main()
