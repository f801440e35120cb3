"""Reports: pages and their forms, the look of figures, manifests, exports."""
