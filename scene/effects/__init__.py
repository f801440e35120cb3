"""Effects that a scene may have: layer, temperature, heating, friction in the interface."""
