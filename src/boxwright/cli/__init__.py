"""The command line. Imports everything; nobody imports it."""


def main() -> None:
    raise SystemExit("boxwright: no command is built yet")
