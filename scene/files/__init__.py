"""Files: scenes, tables and heights as they are read, and what is wrong with them."""
