# many_runs.py FROM.db TO.db: makes a database of 10,000 runs out of one that has a few. Their
# settings and all their metrics differ, so that nothing about them can be stored in short.
import random
import re
import shutil
import sqlite3
import sys

source, target = sys.argv[1:]
shutil.copyfile(source, target)
database = sqlite3.connect(target)
database.row_factory = sqlite3.Row
run = dict(database.execute("SELECT * FROM runs WHERE outcome = 'passed'").fetchone())
database.execute("DELETE FROM runs")
columns = list(run)
insert = 'INSERT INTO runs ({}) VALUES ({})'.format(
    ",".join('"%s"' % column for column in columns), ",".join("?" * len(columns)))
random.seed(1)
for number in range(10000):
    row = dict(run)
    for column, value in run.items():
        if isinstance(value, float):
            row[column] = (value or 1) * random.uniform(0.5, 1.5)
        elif isinstance(value, int) and value > 100:
            row[column] = int(value * random.uniform(0.5, 1.5))
    settings = {"datapath.rom_address_bits": random.randint(6, 13),
                "datapath.diffuse_fraction_bits": random.randint(4, 24)}
    row.update(settings)
    for key, value in settings.items():
        row["command"] = re.sub(key + r"=\d+", f"{key}={value}", row["command"])
    row["identity"] = f"{number:016x}"
    row["configuration_hash"] = f"{random.getrandbits(64):016x}"
    database.execute(insert, [row[column] for column in columns])
database.commit()
