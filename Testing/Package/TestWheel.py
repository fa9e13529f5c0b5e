"""The installed wheel, where nobody has VTK: python3 TestWheel.py FOLDER FOLDER_OF_TestNumpy."""
import signal
import sys
import threading
import time
import unittest

for missing in ("vtk", "vtkmodules", "paraview"):
    sys.modules[missing] = None
sys.path[:0] = sys.argv[1:3]

import gridfem
from TestNumpy import Numpy, unit_sphere  # its tests run here as well


class Wheel(unittest.TestCase):

    def test_it_is_the_installed_one(self):
        self.assertTrue(gridfem.__file__.startswith(sys.argv[1]), gridfem.__file__)

    def test_control_c_ends_a_computation(self):
        self.addCleanup(signal.signal, signal.SIGALRM, signal.getsignal(signal.SIGALRM))
        signal.signal(signal.SIGALRM, signal.default_int_handler)  # as Ctrl-C does
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            signal.setitimer(signal.ITIMER_REAL, 0.5)
            gridfem.spectrum(*unit_sphere(), 2000, Depth=6)
        self.assertLess(time.monotonic() - begin, 10.0)

    def test_other_threads_go_on(self):
        begin = time.monotonic()
        seconds = []
        thread = threading.Thread(
            target=lambda: (gridfem.spectrum(*unit_sphere(), 100, Depth=6),
                            seconds.append(time.monotonic() - begin)))
        thread.start()
        pauses = []
        while thread.is_alive():
            before = time.monotonic()
            time.sleep(0.001)
            pauses.append(time.monotonic() - before)
        # One that held the interpreter would be one pause, as long as the computation.
        self.assertLess(max(pauses), 0.8 * seconds[0])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
