"""The errors behind `BEM.for_accuracy`, and whether its promises are kept."""
