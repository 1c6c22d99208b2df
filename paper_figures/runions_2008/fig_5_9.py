"""
Figure 5.9: key-frames
======================

The key-frames of the first leaf of Arabidopsis, to scale.
"""

from pathlib import Path

from ages import axes_to_scale, draw_bar, draw_surface, keyframed_growth
from panels import draw_margin, output_of

from vasc.render import save


def main(output: Path) -> None:
    """Draw the figure."""
    growth = keyframed_growth("arabidopsis-first-leaf")
    steps = [round(time / growth.step_duration) for time in growth.times.tolist()]
    blades = [growth.domain(step) for step in steps]
    figure, rows, views = axes_to_scale([[blade.bounds for blade in blades]], [1.0])
    for number, (step, blade, ax) in enumerate(zip(steps, blades, rows[0], strict=True)):
        draw_margin(ax, blade.rings[0], linewidth=0.6)
        if number > 1:
            draw_surface(ax, growth, step)
        top = blade.bounds[3] + 12.0
        ax.text(0.0, top, f"{chr(ord('a') + number)})", ha="center", va="bottom")
    draw_bar(rows[0][-1], views[0][-1], 50.0)
    save(figure, output)


if __name__ == "__main__":
    main(output_of())
