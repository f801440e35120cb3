"""Texts on the page of the paper."""

from . import parameters
from .losses import ONE

ABOUT = (
    "Popov, Voll, Li, Chai and Popov (Sci. Rep. 4, 3750, 2014) derive the friction of a rough cone and a rough "
    "sphere on an elastomer from a one-dimensional foundation. This page simulates their figures and parameter "
    "studies again, in the one-dimensional model alone, and judges each claim. μ̃ is the coefficient of "
    "friction over √2 times the rms slope of the roughness, ξ is the variable of Eq. 18, and Eq. 19 "
    "is μ̃ = (1 + ξ^(−α))^(−1/α)."
    "\n\nIntervals are of 95 %, over rough profiles. The error of the grid is exactly zero: the body is the "
    "straight line between its nodes, the flow past it is solved without discretisation, and the pixel is by "
    "definition the cut-off of the roughness, one of the parameters of Fig. 3."
)
SHIFTS = (
    "Eq. 23 shifts curves of friction against load along the load, by a factor that goes as v^(−3β/2) for "
    "a sphere where the loss goes as ω^β. In full contact a power of the frequency gives the same "
    "factor for every wave: Eq. 22 has this shift with the loss of the shortest wave, and also with the loss of "
    "every wave. The friction of the smooth body grows with the load while that of the roughness falls; where the "
    "smooth body counts, no shift brings the curves onto one. The paper presupposes a constant macroscopic "
    "modulus |G(v/a)|. Where it is constant, the simulated friction less that of the smooth body "
    "shifts as claimed. With the time of Fig. 4, τ = 1 ms, the modulus grows with the speed, the contact "
    "shrinks, and the shift comes out too small, most of all at β = 0.1."
    "\n\nStraight parallel lines come onto one curve by a horizontal shift as well as by a vertical one. Collapse "
    "and exponent are therefore undecided there, and the numbers take the shifts for horizontal. Forms of Eq. 22 "
    f"have no scatter: their curves count as one where they miss one another by no more than {ONE:.0%}."
)
OPEN = (
    "- Fig. 3 varies one parameter and does not state the others. Here they are those of Fig. 4: "
    f"F_N = {parameters.LOAD:g} N, G = 1 MPa, h₀ = 50 µm, τ = 1 ms, Δx = 2 µm, θ = "
    f"10°, and the speed is {parameters.LOW_SPEED * 1e3:g} mm/s."
    "\n"
    "- The paper does not say whether θ is the angle of the body or of its line. Here it is that of the "
    "body, so that the line is steeper by π/2."
    "\n- The paper does not say how the twenty values of a parameter are spaced. Here they are spaced "
    "geometrically, angles evenly. Spacings of the grid are moved by at most 2 %, to where a Fourier transform "
    "over 10 mm is fast."
    "\n- The rms slope is that of finite differences on the grid, the slope of the line that is solved. The "
    "spectral one is larger, and the plateau then reads 0.86."
    "\n- The measured friction of Figs. 5 to 7 was not published. Here it is simulated, on the sphere of Fig. 4 "
    f"with H = {parameters.LOSS_ROUGH.hurst:g}, h₀ = {parameters.LOSS_ROUGH.rms_height * 1e6:g} µm and "
    "G(ω) = G₀ (1 + (iωτ)^β), so that G'' is the power law of Eq. 24. "
    "crosscheck mastercurve data.csv treats measured friction in the same way."
    "\n\nWith these parameters the rms slope is about 2, where no linear theory of contact applies. The figures "
    "are about the model, as published."
)
