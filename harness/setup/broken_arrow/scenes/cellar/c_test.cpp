// No list of sources names this.
const auto file = testing::TempDir() + "c.txt";
