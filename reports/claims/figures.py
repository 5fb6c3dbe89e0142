"""Describe the papers' figures that are pictures: which settings on which surfaces they show."""

from __future__ import annotations

from dataclasses import dataclass

import pandas as pd

from reports import wording
from reports.analysis import derive
from reports.claims import picks
from reports.claims.evidence import Evidence, Pick, run_of


@dataclass(frozen=True)
class Figure:
    """Describe a figure of a paper that shows pictures, and how ours of it are made."""

    title: str
    told: str  # what the paper's figure shows, and what ours
    caption: str  # what to look for
    config: str  # whose rows are shown
    surfaces: tuple[str, ...]
    settings: tuple[Pick, ...]  # drawn one after the other on each surface
    made: str = ""  # how ours are made, for who wants to know
    judged: bool = True  # whether its section ends with the config's verdicts, which else end another section


FIGURES = (
    Figure(
        "toledo2007, Figure 2",
        "The paper shows cubics in the box [−1, 1]³ by Sturm's method, and reports errors close to singular points.",
        "Look for wrong rays at nodes and along the handles of umbrellas.",
        "toledo-fig2.toml",
        picks.CUBICS,
        (picks.STURM,),
    ),
    Figure(
        "toledo2007, Figure 2, zoomed",
        "The paper says that errors close to singular points are evident after zooming. Here: Ding-Dong at its node "
        "and both umbrellas where their handles end, in windows 0.2 and 0.03 wide.",
        "Look along the umbrellas' handles.",
        "toledo-fig2-zoom.toml",
        picks.CUBICS[2:3] + picks.CUBICS[4:],
        (picks.STURM,),
    ),
    Figure(
        "toledo2007, Figure 2, a node",
        "The same at one of the four nodes of Cayley's cubic.",
        "Look for wrong rays at the node.",
        "toledo-fig2-node.toml",
        ("cayley",),
        (picks.STURM,),
    ),
    Figure(
        "toledo2007, Figure 4",
        "The paper shows a torus on which Sturm's method fails at one viewing angle, and draws the ray on which sphere "
        "tracing is slow. Here: the torus at Table 1's six angles.",
        "Look for Sturm's wrong rays near edges, of which D.D. Bisection has none, and for the rays close to the torus "
        "that Newton's signed steps as printed leave exhausted; our steps forwards leave none.",
        "toledo-fig4.toml",
        ("torus",),
        (picks.STURM, picks.BISECTION, picks.ONE_RAY, picks.NEWTON_3, picks.NEWTON_3_FORWARDS),
    ),
    Figure(
        "szente, Figure 1",
        "The paper shows the Endraß octic in float32 without EFT, with EFT, and with EFT and direct evaluation. Here "
        "the Barth decic and the 16-ball stand beside it, and the Bernstein basis beside the monomial one.",
        "Look at the error maps: direct evaluation clears the bands, and EFT matters most in the Bernstein basis and "
        "at degree 16.",
        "szente-fig1.toml",
        picks.HIGH_DEGREE,
        (picks.NEITHER, picks.NO_EVAL, picks.FIT, picks.NO_EFT, picks.BERNSTEIN_NEITHER, picks.BERNSTEIN_NO_EVAL),
        "Rays start where they come closest to the centre, whatever the camera's distance, which keeps the samples of "
        "f themselves exact to float32's last bits; a renderer that starts at the camera adds the rounding of its "
        "distance to them.",
    ),
    Figure(
        "szente, Figure 2",
        "The paper shows the calyx, the 16-ball and the Endraß octic, and calls its pictures more accurate around thin "
        "features than the ray marching it takes as truth. Both are held against certified hits here.",
        "Look at the calyx's cusp.",
        "szente-fig2.toml",
        ("calyx", "sixteen_ball", "endrass_octic"),
        (picks.FIT, picks.MARCH),
    ),
    Figure(
        "beamcasting, Figures 2 to 4",
        "The paper shows its twelve surfaces with 1 and with 4 samples per pixel; here they are by adaptive beams as "
        "printed.",
        "Look at silhouettes: "
        "4 samples smooth their steps, and narrower beams touch less of what their centre rays pass by.",
        "beamcasting-tables.toml",
        tuple(picks.BEAM_SURFACES),
        (picks.ADAPTIVE,),
        "The pictures are of the rays of the accuracy check; of 4 samples a pixel has the mean of their colours.",
        judged=False,
    ),
)


def rows_of(figure: Figure, evidence: Evidence) -> pd.DataFrame:
    """Return the rows that `figure` shows, of the first device, in the figure's order, with the column `setting`."""
    found = []
    for pick in figure.settings:
        rows = evidence.of(figure.config).rows(pick, figure.surfaces)
        rows = rows[rows["run"] == run_of(figure.config)]
        found.append(rows.assign(setting=pick.words))
    rows = pd.concat(found)
    if rows["samples_per_pixel"].nunique() > 1:
        rows["setting"] += rows["samples_per_pixel"].map(lambda n: f", {wording.plural(n, 'sample')} per pixel")
    rows = derive.on_first_device(rows)
    rows = rows.assign(place=[figure.surfaces.index(surface) for surface in rows["surface"]])
    return rows.sort_values(["place", "view"], kind="stable").drop_duplicates(["surface", "view", "setting"])
