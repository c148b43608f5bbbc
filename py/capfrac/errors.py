"""What can go wrong, by kind. Every message names the culprit, its value and what is allowed."""


class CapfracError(Exception):
    """Any problem that capfrac reports."""


class CaseError(CapfracError, ValueError):
    """A case file or an argument with an unknown or impossible entry. Names the key, the value and what is allowed."""


class SampleError(CapfracError):
    """A sample that cannot be made or brought to the requested state."""


class SceneError(CapfracError):
    """A YADE scene that is not in the state that a function needs. The scene has not been changed."""


class RunFolderError(CapfracError):
    """A run folder that cannot be used, as it is or at all."""
