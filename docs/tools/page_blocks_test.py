#!/usr/bin/env python3
"""What blocks of a page mean, and that a quote which is not true is found."""

import sys
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
from page_blocks import Block, blocks_of, commands_of, first_misfit


class Blocks(unittest.TestCase):
    def test_a_page_has_its_fenced_blocks_and_their_lines(self):
        found = blocks_of("words\n```toml\na = 1\n```\nmore\n\n```console\n$ ls\n```\n")
        self.assertEqual([(b.line, b.language, b.text) for b in found], [(3, "toml", "a = 1\n"), (8, "console", "$ ls\n")])

    def test_a_block_without_an_end_is_a_mistake(self):
        self.assertRaises(ValueError, blocks_of, "```toml\na = 1\n")

    def test_commands_go_on_behind_a_backslash_and_to_the_end_word(self):
        text = "$ one \\\n  two\nsaid\n$ cat <<'END'\n$ not a command\nEND\n"
        found = commands_of(Block(10, "console", text))
        self.assertEqual([c.text for c in found], ["one \\\n  two", "cat <<'END'\n$ not a command\nEND"])
        self.assertEqual((found[0].line, found[0].quoted), (10, ["said"]))

    def test_output_before_any_command_is_a_mistake(self):
        self.assertRaises(ValueError, commands_of, Block(1, "console", "said\n"))


class Quotes(unittest.TestCase):
    said = ["plan:", "3 facets", "in 1.7 s", "done"]

    def test_what_is_not_quoted_may_be_anything(self):
        self.assertIsNone(first_misfit([], self.said))

    def test_all_lines_are_compared_where_nothing_is_left_out(self):
        self.assertIsNone(first_misfit(self.said, self.said))
        self.assertIsNotNone(first_misfit(["plan:", "4 facets", "in 1.7 s", "done"], self.said))
        self.assertIsNotNone(first_misfit(["plan:", "3 facets"], self.said))
        self.assertIsNotNone(first_misfit(["3 facets", "in 1.7 s", "done"], self.said))

    def test_dots_stand_for_lines_and_an_ellipsis_for_words(self):
        self.assertIsNone(first_misfit(["...", "3 facets", "..."], self.said))
        self.assertIsNone(first_misfit(["plan:", "...", "in … s", "done"], self.said))
        self.assertIsNotNone(first_misfit(["...", "in … min", "..."], self.said))

    def test_columns_may_be_wider(self):
        self.assertIsNone(first_misfit(["...", "3   facets", "..."], self.said))
        self.assertIsNotNone(first_misfit(["...", "3facets", "..."], self.said))

    def test_order_counts(self):
        self.assertIsNotNone(first_misfit(["...", "done", "...", "3 facets", "..."], self.said))

    def test_signs_of_patterns_are_themselves(self):
        self.assertIsNotNone(first_misfit(["p.an:", "..."], self.said))


if __name__ == "__main__":
    unittest.main()
