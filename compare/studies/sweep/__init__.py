"""One scene at many speeds and loads: crosscheck sweep."""
