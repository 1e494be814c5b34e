"""The one exception for bad input, and the category of a render's warnings."""


class InputError(ValueError):
    """Bad input: a scene, an image, an array or an argument.

    The text begins with ``file:line:col: error:``, or with the name of a whole file or argument. A scene's line and a
    caret follow it.
    """

    place: str  #: "file:line:col", or the name of a whole file or argument.
    line: int  #: From 1; 0 without a position.
    column: int  #: From 1; 0 without a position.
    message: str  #: The text behind "error: ".

    def __init__(self, text: str, place: str = "", line: int = 0, column: int = 0, message: str = "") -> None:
        super().__init__(text)
        self.place, self.line, self.column, self.message = place, line, column, message or text

    def __reduce__(self) -> "tuple[object, ...]":
        return type(self), (str(self), self.place, self.line, self.column, self.message)


def refusal(place: str, message: str) -> InputError:
    """An error about a whole argument."""
    return InputError(f"{place}: error: {message}", place, 0, 0, message)


class RenderWarning(UserWarning):
    """A scene is rendered differently from its file, or its image may lack light."""
