// No list of sources names this.
