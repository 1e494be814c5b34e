int answer = 42;  // a comment does not count
