# %% [markdown]
# Which method draws a surface of one's own here, how fast, and how exactly? (This script is a notebook too: jupytext.)
# %%
from pathlib import Path

import matplotlib.pyplot as plt

import firsthit

FORMULA = "*".join(f"(({a}^2 + {b}^2 - 0.8)^2 + ({c}^2 - 1)^2)" for a, b, c in ("xyz", "yzx", "zxy")) + " - 0.06"
Path("cube.toml").write_text(f'''title = "A cube of rings"
surfaces = ["cube"]
surface.cube = {{ domain = "sphere:1.6", formula = "{FORMULA}" }}
devices = ["any"]
sizes = [256]
budget.seconds = 0.3
method = [ {{ name = "newton", parameters = {{ EPSILON = [0.01, 0.001, 0.0001] }} }},
    {{ name = "bernstein", parameters = {{ TOLERANCE = [0.01, 0.001, 0.0001] }} }},
    {{ name = "interval_march", parameters = {{ TOLERANCE = [0.001, 0.0001, 0.00001] }} }},
    {{ name = "ray_march", parameters = {{ STEPS = [30, 100, 300] }} }} ]''')
table = firsthit.load(firsthit.run("cube.toml", tell=print).folder)
# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4.2), layout="constrained", width_ratios=(2, 3))
cube = firsthit.surfaces.from_formula(FORMULA, "sphere:1.6")
left.imshow(firsthit.render(cube, "newton", view=(35, 25)))
left.set_axis_off()
for method, rows in table.groupby("method"):
    right.loglog(rows["median_ms"], rows["error_max"], "o-", label=method)
for row in table[table["wrong_rays"] > 0].itertuples():
    below = {"xytext": (0, -16), "textcoords": "offset points", "ha": "center"}
    right.annotate(f"{row.wrong_rays} rays wrong", (row.median_ms, row.error_max), **below)
right.set(xlabel="time for 256 × 256 pixels, ms", ylabel="largest error of the right hits, scene units")
right.margins(0.12)
right.legend(frameon=False)
figure.savefig("cube.png", dpi=150)
