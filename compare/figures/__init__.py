"""Figures of a judgement, a module each: figure(judgement) -> Figure, sheets(judgement), caption(judgement)."""
