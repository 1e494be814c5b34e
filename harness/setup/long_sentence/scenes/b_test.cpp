const char* expected = "of all messages this one is a test's";
