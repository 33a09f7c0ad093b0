"""python3 -m make: writes every statement below the directory above this one, and deletes what is none any more."""

from pathlib import Path

from .catalogue import files

root = Path(__file__).resolve().parent.parent
texts = files()
for path in root.glob("*/*.smt2"):
    if str(path.relative_to(root)) not in texts:
        path.unlink()
for name, text in texts.items():
    path = root / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, encoding="utf-8")
print(f"{len(texts)} files")
