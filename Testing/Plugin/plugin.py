"""What the plugin's tests share: the plugin, a surface, and access to filters and their data."""
import os

from paraview import servermanager, simple

PROXIES = ("ClipToOctree", "ConnectivityAwareBasis", "ScreenedPoisson", "LaplaceSpectrum",
           "MeanCurvatureFlow", "SpectralSignatures")
SOLVERS = PROXIES[2:]

# vtkSurfaceFEMAlgorithm::StageType
STAGES = ("space", "system", "hierarchy", "right-hand side", "solve")


def load():
    """Loads the plugin; its filters become functions of paraview.simple."""
    simple.LoadPlugin(os.environ["GRIDFEM_PLUGIN"], remote=False, ns=vars(simple))


def sphere():
    """A sphere of radius 1."""
    return simple.Sphere(Radius=1.0, ThetaResolution=40, PhiResolution=20)


def data(proxy, port=0):
    """The data object of an output port, brought up to date."""
    proxy.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def runs(proxy):
    """How often the filter behind a proxy has run each stage."""
    counts = proxy.GetClientSideObject()
    return {stage: counts.GetNumberOfRuns(number) for number, stage in enumerate(STAGES)}


def reruns(proxy, change):
    """The stages that run again after `change`."""
    before = runs(proxy)
    change()
    proxy.UpdatePipeline()
    after = runs(proxy)
    return [stage for stage in STAGES if after[stage] != before[stage]]
