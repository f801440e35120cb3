"""What the package has of the trust map, made of its campaign: `python docs/trust.py crosscheck-study`.

The folder is that of `crosscheck study trust --size standard`, with its page in trust-standard. Written are the
measured tables and what is fitted to those learned from, beside the modules that read them.
"""

import sys
from pathlib import Path

import compare
from compare.studies.trust import shipped, table
from compare.studies.trust.model import Model
from compare.studies.trust.ratio import QUANTITIES
from compare.studies.trust.study import HELD_OUT, LEARNED


def main(folder: Path) -> None:
    """Write the tables, and models fitted to what they hold: to five digits, as it is read again."""
    answers = compare.load(folder / "trust-standard")
    for name, path in ((LEARNED, table.LEARNED), (HELD_OUT, table.HELD_OUT)):
        path.write_bytes(table.written(table.columns(answers[name].to_dataset())))
    learned = table.read(table.LEARNED)
    models = {name: Model.fit(name, table.measurements(learned, name)[1]) for name in QUANTITIES}
    shipped.FITTED.write_text(shipped.as_json(models) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
