"""Words of docs/findings.md that no run can show: what sources say, and definitions."""

from collections.abc import Mapping

CITED, MEANT = "as its source prints it", "a definition"
PEOPLE = "of sources and people, not of a run"
SAID: Mapping[str, str] = {
    "limits of distance are fixed numbers in their source": CITED,
    "the velocity of the step before t = 0": MEANT,
    "Warnett and others (2014) measured such an effect": CITED,
    "according to an abstract": CITED,
    "(Hsieh and others 2011; Korzec and Jankowski 2018)": CITED,
    "(Wartman, Seed and Bray 2005, whose rigid blocks move by 27 to 225 % of what was measured)": (
        CITED
    ),
    "Tsesarsky, Hatzor and Sitar (2005)": CITED,
    "(Sarlin and others 2021), rods (Trepanier and Franklin 2010)": CITED,
    "effect of the size of grains (Warnett and others 2014)": CITED,
    "A measured discharge of plastic spheres from a hopper lies in the scripts of DEM-Engine": (
        PEOPLE
    ),
    "Mankoc and others (2007)": CITED,
    "Foerster and others (1994) and Lorenz, Tuozzolo and Louge (1997)": CITED,
    "Lyashenko, Willert and Popov": CITED,
    "(2012, arXiv:1204.0001)": CITED,
    "No source states the uncertainty of Kharaz' measurements": PEOPLE,
    "The points that are judged were chosen by people who knew where the laws fail": PEOPLE,
    "The published shortfall of T_u of blocks, 8.89 % on average": CITED,
    "the paper's mean of C_u, 18.51 % below": CITED,
    "Neither does the area that C_u is divided by, since E is divided by the same": MEANT,
    "The paper does not mention such platens": PEOPLE,
    "The paper has 16.2 % and 2.83e-6 s, at a 25th of the rate": CITED,
}
