"""A scene that moves: crosscheck animate."""
