"""What the page of the paper says beside its numbers."""

from . import parameters
from .losses import ONE

ABOUT = (
    "Popov, Voll, Li, Chai and Popov (Sci. Rep. 4, 3750, 2014) derive the friction of a rough cone and a rough "
    "sphere on an elastomer from a one-dimensional foundation. This is their simulation again: its figures, "
    "its parameter studies, and what becomes of each claim, in the one-dimensional model alone. μ̃ is the "
    "friction coefficient over √2 times the rms slope of the roughness, ξ the variable of Eq. 18, and Eq. 19 "
    "is μ̃ = (1 + ξ^−α)^(−1/α).\n\nIntervals are of 95 %, over rough profiles. The error of the grid is "
    "exactly zero: the body is the straight line between its nodes, the flow past it is solved without "
    "discretisation, and the pixel is the cut-off of the roughness by definition, one of the parameters of "
    "Fig. 3."
)
SHIFTS = (
    "Eq. 23 shifts curves of friction against load along the load, by a factor that goes as v^(−3β/2) for a "
    "sphere where the loss goes as frequency^β. In full contact a power of the frequency is the same factor "
    "for every wave: Eq. 22 has this shift with the loss of the shortest wave and with that of every wave "
    "alike. The friction of the smooth body grows with the load where that of the roughness falls, and with it "
    "nothing is a shift any more. Where the macroscopic modulus |G(v/a)| is constant, as the paper "
    "presupposes, what simulated friction exceeds that of the smooth body by shifts as claimed. With the time "
    "of Fig. 4, τ = 1 ms, the modulus grows with the speed, the contact shrinks, and the shift comes out too "
    "small, most of all at β = 0.1.\n\nStraight parallel lines come onto one curve, but cannot tell a "
    "horizontal shift from a vertical one: collapse and exponent are undecided there, and the numbers are "
    "those of shifts taken for horizontal. Forms of Eq. 22 have no scatter: their curves are one where they "
    f"miss one another by no more than {ONE:.0%}."
)
OPEN = (
    f"- What is held while one parameter varies in Fig. 3: here the set of Fig. 4, F_N = {parameters.LOAD:g} N, "
    f"G = 1 MPa, h₀ = 50 µm, τ = 1 ms, Δx = 2 µm, θ = 10°. The speed: here {parameters.LOW_SPEED * 1e3:g} "
    "mm/s.\n- Whether θ is the angle of the body or of its line: here of the body, so that the line is steeper "
    "by π/2.\n- How the twenty values lie in their range: here geometrically, angles evenly. Spacings are "
    "moved by at most 2 % to where a Fourier transform over 10 mm is fast.\n- The rms slope: here by finite "
    "differences on the grid, the slope of the line that is solved. The spectral one is larger, and the "
    "plateau then reads 0.86.\n- The measured friction of Figs. 5 to 7 was not published. Here it is "
    f"simulated, on the sphere of Fig. 4 with H = {parameters.LOSS_ROUGH.hurst:g}, h₀ = "
    f"{parameters.LOSS_ROUGH.rms_height * 1e6:g} µm and G(ω) = G₀ (1 + (iωτ)^β), so that G″ is the power law of "
    "Eq. 24; friction that you measured takes the same way with `crosscheck mastercurve data.csv`.\n\nWith "
    "these parameters the rms slope is about 2, where no linear theory of contact applies. The figures are "
    "about the model, as published."
)
