"""Puts messages of the filters into the words of the functions, whose users see no panels."""

import re

# The arguments of functions, by the filters and the labels of the properties that they set.
_ARGUMENTS = {
    "FarthestPoints": {"Number Of Points": "number"},
    "FunctionalMap": {"Number Of Modes": "number", "Landmarks": "landmarks"},
    "GaussianField": {"Number Of Samples": "number", "Range": "distance", "Observation Noise": "noise"},
    "GeodesicDistance": {"Source Point Ids": "sources"},
    "GeodesicPaths": {"Source Point Ids": "ids"},
    "HeatDiffusion": {"Diffusion Time": "time", "FWHM": "fwhm", "Sigma": "sigma"},
    "LaplaceSpectrum": {"Number Of Modes": "number"},
    "MeanCurvatureFlow": {"Number Of Steps": "steps"},
    "SpectralSignatures": {"Number Of Modes": "number"},
    "SurfaceDetail": {"Detail Scale": "scale"}}

# Patterns and their replacements, in order.
_WORDS = (
    (r", for example with the Calculator", ""),
    (r"\b(Array '\w+' has \d+|as many) component", r"\1 column"),
    (r"(?:The )?(?:[A-Z]\w* )*Array '(\w+)'", r"\1"),
    (r"\b(?:[Aa] )?Constraint Array", "held"),
    (r"\b(?:[Aa] )?Boundary Flux Array", "flux"),
    (r"by Source Array, Selection or Sources, or leave fragments out with the filter Connectivity",
     "by sources, or leave out the cells of these components"),
    (r"Choose fewer points by a Mask Array, or put NaN at the others", "Choose fewer ids"),
    (r"(instead of the \d+) of the Array\b", r"\1 of the values"),
    (r"needs point data, but '(\w+)' is a cell array\. Convert it with Cell Data to Point Data\.",
     r"needs values at points, but \1 has a row for each cell."))


def in_words_of_functions(name, text, given):
    """Returns a message of the filter of this name. given: the names of the arrays of the call."""
    for pattern, words in _WORDS:
        text = re.sub(pattern, words, text)
    for label, argument in _ARGUMENTS.get(name, {}).items():
        text = re.sub(rf"\b{label}\b", argument, text)
    reason = "NaN, or held is false there" if "held" in given else "NaN"
    return text.replace("all are NaN, masked, or not selected", "all are " + reason)
