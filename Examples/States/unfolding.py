"""A ParaView state: a trefoil whose strands nearly touch flows to a sphere of its area, with plain
functions on the left and connectivity-aware ones on the right.

In ParaView: File > Load State (with the plugin loaded), or with a mesh of your own

    GRIDFEM_MESH=output/modes.vtp paraview --script=unfolding.py

GRIDFEM_MESH names a .vtp file. Play the animation: plain functions feel both strands where they
share a cell, so that the strands stay together; connectivity-aware ones let them part.

With UNFOLDING_PICTURE=FILE.png the frames are drawn side by side into a picture.
"""
