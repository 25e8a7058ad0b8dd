# The set-up is all in tools/environment: it makes what is missing, below build/.
.PHONY: help demo test test-all test-rest test-long lint test-qgis coverage judge evidence docs translations package release clean

help:  ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## /  \1\t/p' Makefile | expand -t 14

demo:  ## classify LAS=tile.laz (TRUTH=reference.laz), LAND=mountain, campus or court, or a generated scene, into demo-output/; QGIS=1: by an installed QGIS; JOB=survey: the data of a tutorial
	@tools/environment demo -m demo $(if $(JOB),--job $(JOB)) $(if $(LAND),--land $(LAND)) $(if $(QGIS),--qgis) $(if $(LAS),"$(LAS)") $(if $(TRUTH),--truth "$(TRUTH)")

test:  ## run the daily tests and checks, installing a QGIS if there is none; ROOM=las or ROOM=tools/check: those of a room, and the walls
	@tools/test $(if $(ROOM),room,core style qgis)

test-all: test test-rest  ## run all that CI runs here

test-rest:  ## run what `test` leaves out of it: what costs more, processors with fewer instructions, files as on Windows, and Python 3.9 with the oldest NumPy and SciPy
	@tools/test rest gates qgis_rest levels windows oldest

test-long:  ## run the tests that all of these leave out, for they take long
	@tools/test long

lint:  ## check the style, the types, and what plugins.qgis.org checks
	@tools/test lint

test-qgis:  ## run all tests of the plugin in the real QGIS
	@tools/test qgis qgis_rest

docs:  ## build the pages as a site, build/site/index.html
	@tools/environment python -m pip install --quiet --editable ".[docs]"
	@tools/environment python -m mkdocs build --quiet --strict

translations:  ## write what there is to translate into plugin/i18n/*.ts, and try what is translated
	@tools/environment install-qgis
	@tools/environment qgis /usr/bin/python3 tools/translations.py

package:  ## pack the last commit, with laspy, as dist/bare_earth-X.Y.Z.zip, to install in QGIS
	@tools/environment package

release:  ## build zip, sdist, wheel and recipe of the last commit into dist/, and check them as plugins.qgis.org, PyPI and conda do
	@tools/environment release

coverage:  ## tell which lines no test runs, those of the plugin in the real QGIS
	@tools/test coverage

judge:  ## compare the filters with those of the last commit, or of AGAINST=main, in two minutes: a table for a pull request
	@tools/environment python -m benchmarks.judge $(if $(AGAINST),--against $(AGAINST))

evidence:  ## measure the pages of benchmarks/results/ that are older than the code, and the tables made from them; PART=plain: a part
	@tools/environment python -m benchmarks.evidence --run $(PART)

clean:  ## remove what these made
	rm -rf build dist demo-output bare_earth.egg-info
