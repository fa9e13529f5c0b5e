"""Tests filters on several ranks in a build without MPI: rank 0 gathers."""
import unittest

import ranks


class WithoutMpi(unittest.TestCase):
    def test_rank_0_gathers(self):
        for name, array in (("ScreenedPoisson", "Solution"), ("LaplaceSpectrum", "Mode001")):
            filter_ = ranks.make(name)
            warnings = ranks.heard(filter_, "WarningEvent")
            output = ranks.run(filter_, ranks.piece(ranks.ellipsoid(), "contiguous"))[0]
            problems = [] if output.GetPointData().HasArray(array) else [f"no {array}"]
            problems += warnings
            problems += ["by all ranks"] if output.GetFieldData().HasArray("Distributed") else []
            ranks.check(self, problems)


if __name__ == "__main__":
    ranks.main()
