"""Published numbers and the checks that hold runs against them."""
