# crashed_runs.py FILE.db: makes crashed runs, which have no result, of all runs of a database.
import sqlite3
import sys

database = sqlite3.connect(sys.argv[1])
described = ["identity", "text", "command", "scene", "scene_hash", "hardware", "outcome", "message", "bucket",
             "verified_by", "configuration_hash", "seconds"]
columns = [row[0] for row in database.execute("SELECT name FROM pragma_table_info('runs')")]
results = [name for name in columns if name not in described and "." not in name]
database.execute("UPDATE runs SET outcome = 'crashed', message = 'signal 11', {}".format(
    ", ".join(f'"{name}" = NULL' for name in results)))
database.commit()
