"""Python reads our TOML, which it does by version 1.0: python toml_1_0.py FILE.. (of .md the examples)."""
import pathlib
import re
import sys
import tomllib

files = [pathlib.Path(name) for name in sys.argv[1:]]
count = 0
for file in files:
    text = file.read_text(encoding="utf-8")
    for part in re.findall(r"^```toml\n(.*?)^```", text, re.S | re.M) if file.suffix == ".md" else [text]:
        count += 1
        try:
            tomllib.loads(part)
        except tomllib.TOMLDecodeError as error:
            sys.exit(f"{file}: {error}; TOML 1.0 has no line breaks and no last comma in {{ }}")
print(f"{count} texts are TOML 1.0")
