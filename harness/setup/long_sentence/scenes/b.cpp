const char* right = "of a whole, which a value begins: " + name("a sentence of its own");
const char* values = name + " of a value is right, and so is " + quoted("which '\"' is in brackets") + " beside it";
// "of a comment"
const char* joined =
    "this message has a value, and so many words that nobody reads it to its end: " + name(1, "short") +
    " counts as one of them, and the last is number thirty one right here";
const char* others = R"(of other programs is this text)"
                     "of a page is this text: <g class='x'>";
const char* pieces =
    "these two literals are one message that is right, and the second begins with some word that begins none: "
    "of all words";
