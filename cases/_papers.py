"""The papers that most cases come from, cited once: what a Source begins with, citation and DOI."""

LI_2018 = (
    "Li, Yin, Jia, Zhang, Wang and Xu (2018), Validation Tests for Discrete Element Codes "
    "Using Single-Contact Systems, International Journal of Geomechanics",
    "10.1061/(ASCE)GM.1943-5622.0001133",
)
LIU_2017 = (
    "Liu, Xu, Shi, Deng and Zhu (2017), Mechanical properties and energy conversion of 3D "
    "close-packed lattice model for brittle rocks, Computers and Geosciences 103",
    "10.1016/j.cageo.2017.03.003",
)
YAGODA_BIRAN_2016 = (
    "Yagoda-Biran and Hatzor (2016), Benchmarking the numerical Discontinuous Deformation "
    "Analysis method, Computers and Geotechnics 71, 30-46",
    "",
)
