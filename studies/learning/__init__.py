"""The learning track: five ways of learning to drive from words and memory, compared by steps."""
