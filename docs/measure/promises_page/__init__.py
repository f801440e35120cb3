"""The errors behind `bem3d.for_accuracy`, and whether its promises are kept."""
