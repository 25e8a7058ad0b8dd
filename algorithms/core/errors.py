"""The two ways in which a computation of this package ends early."""


class BareEarthError(Exception):
    """Something the user can mend; the text says in a sentence what is wrong and what to do."""


class Cancelled(Exception):
    """The user asked to stop. Whoever catches it leaves nothing half written behind."""
