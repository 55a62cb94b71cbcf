# The app in a browser: the page as a user meets it, in Chromium and Firefox.
. tests/check.sh
. tests/web/page.sh python3
PYTHONPATH=tests/web python3 -c 'import sys, chromium; sys.exit(not chromium.find())' || { echo "skip - chromium is not installed"; exit 0; }
mkdir -p "$TEST_OUT/looks"
timeout 600 python3 tests/web/app.py "$page" "$TEST_OUT/looks"
ok "the page is as users meet it" $?
